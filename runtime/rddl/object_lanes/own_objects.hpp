// Packs of environments in which each environment takes an object of its own.
//
// A loop over all objects makes random numbers for every environment at each object that one of
// them has chosen. Where each environment has chosen few, the first of each make a turn, then the
// second ones, and so on: elements of tables are gathered, and the bools that are stored are bits
// of a word in each lane. A draw has the number of its object, so the values are the same.
#pragma once

#include <rddl/lanes/pack.hpp>
#include <rddl/object_lanes/objects.hpp>
#include <rddl/random/distributions/discrete.hpp>
#include <rddl/random/random.hpp>
#include <rddl/values/bits.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/pack_ops.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace rddl {

// Named after the level of simd.hpp, as packs are.
inline namespace RDDL_SIMD_LEVEL {

// A lane type: in each lane the value of an object of its own.
template <int n, class R>
struct OwnObjectsOf : Pack<n, R> {};

// In each lane an object that its environment has chosen.
template <int n>
struct OwnObjects {
    using Int = Lanes<std::int64_t, n>;

    const Mask<n>* choices;
    const Mask<n>* kept;  // the bools of objects that are not chosen; null if all are false
    Mask<n> present;      // the lanes that have an object
    Int place;            // 0 in the others
    Int bit;              // of the object, in its word; 0 in the others
    Int& word;            // the bools of 64 objects: those of `kept` until they are stored
};
// The place where their bools are stored.
template <int n>
struct OwnElements {
    const OwnObjects<n>& objects;
    template <class Value>
    RDDL_INLINE void operator=(const Value& value) const {
        const auto cleared = select(LanesOf<Value, n>(value), std::int64_t{0}, objects.bit);
        objects.word = (objects.word | objects.bit) ^ cleared;
    }
};

// A Place whose index differs between the lanes.
template <int n>
struct OwnPlaces {
    std::uint32_t site;
    Lanes<std::int64_t, n> index;
    std::uint32_t series;

    RDDL_INLINE OwnPlaces(std::uint32_t its_site, const OwnObjects<n>& objects)
        : OwnPlaces(its_site, objects, its_site) {}
    RDDL_INLINE OwnPlaces(std::uint32_t its_site, const OwnObjects<n>& objects,
                          std::uint32_t its_series)
        : site(its_site), index(objects.place), series(its_series) {}

    Place in(int lane) const { return {site, index[lane], series}; }
};

}  // namespace RDDL_SIMD_LEVEL

template <int n, class R>
struct Context<OwnObjectsOf<n, R>> {
    Context<Pack<n, R>>& environments;
    Mask<n> active;

    template <class Value>
    RDDL_INLINE Mask<n> require(Mask<n> ok, FaultKind kind, const OwnPlaces<n>& places,
                                const Value& value) {
        if (any(active && !ok)) [[unlikely]]
            record(active && !ok, kind, places, value);
        return ok;
    }

  private:
    template <class Value>
    [[gnu::noinline, gnu::cold]] void record(Mask<n> failed, FaultKind kind,
                                             const OwnPlaces<n>& places, const Value& value) {
        for_each_lane(failed, [&](int lane) {
            const auto others = !Mask<n>::of_bits(std::uint64_t{1} << lane);
            environments.require(others, kind, places.in(lane), value);
        });
    }
};

template <class T, int n, class R>
constexpr T fault(Context<OwnObjectsOf<n, R>>& context, const OwnPlaces<n>& places) {
    context.require(false, FaultKind::Type, places, 0.0);
    return T{};
}

// ------------------------------------------------------------------------------------ draws

template <int n, class R>
RDDL_INLINE Lanes<R, n> uniform_at(Context<OwnObjectsOf<n, R>>& context,
                                   const OwnPlaces<n>& places) {
    auto& environments = context.environments;
    make_schedule(environments);
    const auto indices = words_of(places.index);
    Lanes<R, n> numbers;
    for_each_schedule(environments,
                      [&]<class Word>(const philox::Schedule<philox::draw_rounds, Word>& schedule,
                                      std::size_t i) RDDL_INLINE_LAMBDA {
                          const Word index = part_of<Word>(indices, i);
                          const auto is_odd = detail::lowest_bits(ints_of(index));
                          philox::Block<Word> words;
                          schedule.generate(places.series, index >> 1, words);
                          set_part(numbers, i,
                                   unit_real<R>(select(is_odd, words[2], words[0]),
                                                select(is_odd, words[3], words[1])));
                      });
    if (any(environments.draws_medians))
        return select(environments.draws_medians, Lanes<R, n>{R(median_number)}, numbers);
    return numbers;
}

namespace sample {

template <int n, class R>
RDDL_INLINE Mask<n> bernoulli(Context<OwnObjectsOf<n, R>>& context, const OwnPlaces<n>& places,
                              const std::type_identity_t<Lanes<R, n>>& p) {
    return bernoulli<OwnObjectsOf<n, R>, OwnPlaces<n>>(context, places, p);
}
template <int n, class R>
RDDL_INLINE Mask<n> valid_bernoulli(Context<OwnObjectsOf<n, R>>& context,
                                    const OwnPlaces<n>& places,
                                    const std::type_identity_t<Lanes<R, n>>& p) {
    return valid_bernoulli<OwnObjectsOf<n, R>, OwnPlaces<n>>(context, places, p);
}

}  // namespace sample

// --------------------------------------------------------------------------------- elements

// The bools that choose the objects, and those that the others keep, are known already.
template <class Table, int n>
RDDL_INLINE auto at(const Table& table, const OwnObjects<n>& objects) {
    const auto* const first = &detail::first_part<0>(table);
    if constexpr (std::is_same_v<decltype(first), const Mask<n>* const>) {
        if (first == objects.choices) return objects.present;
        if (first == objects.kept) return (objects.word & objects.bit) != Lanes<std::int64_t, n>{0};
    }
    return detail::gather<detail::Nested<Table>::count>(first, objects.place);
}
template <class Table, int n, class... Indices>
requires(sizeof...(Indices) > 0)  //
    RDDL_INLINE
    auto at(const Table& table, const OwnObjects<n>& objects, const Indices&... indices) {
    using Int = Lanes<std::int64_t, n>;
    using Row = std::remove_cvref_t<decltype(detail::first_part<sizeof...(Indices)>(table))>;
    const Int places =
        objects.place * Int{detail::Nested<Row>::count} + detail::place_in<Row, Int>(indices...);
    return detail::gather<detail::Nested<Table>::count>(&detail::first_part<0>(table), places);
}
template <class Table, int n, class... Indices>
RDDL_INLINE auto at_own(const Table& table, const OwnObjects<n>&, const Indices&... indices) {
    return at(table, indices...);
}
namespace detail {

// Tables of places may have bytes, which are not gathered.
template <const auto& places>
inline constexpr auto wide_places = [] {
    constexpr std::size_t count =
        static_cast<std::size_t>(element_count<std::remove_cvref_t<decltype(places)>>);
    std::array<std::int64_t, count> wide{};
    for (std::size_t x = 0; x < count; ++x)
        wide[x] = static_cast<std::int64_t>(element_at(places, x));
    return wide;
}();

}  // namespace detail

template <const auto& places, class Table, int n>
RDDL_INLINE Mask<n> at_places(const Table& table, const OwnObjects<n>& objects) {
    return detail::gather<detail::Nested<Table>::count>(&detail::first_part<0>(table),
                                                        at(detail::wide_places<places>, objects));
}
template <const auto& rows, const auto&... kinds, int n, class Count>
RDDL_INLINE auto at_row(const OwnObjects<n>& objects, const Count& count) {
    if constexpr (sizeof...(kinds) == 0)
        return at(rows, objects, count);
    else
        return at(rows, at(kinds, objects)..., count);
}
template <const auto& table, int n>
RDDL_INLINE auto chances(const OwnObjects<n>& objects) {
    return at(table, objects);
}

template <class Table, int n>
RDDL_INLINE OwnElements<n> elements(Table&, const OwnObjects<n>& objects) {
    return {objects};
}

// ------------------------------------------------------------------------------------ loops

namespace detail {

// Whether each environment has chosen `most` objects at most.
template <int n, std::size_t count>
RDDL_INLINE bool are_few(const std::array<Lanes<std::int64_t, n>, count>& chosen, int most) {
    Lanes<std::int64_t, n> total{0};
    for (const auto& bits : chosen) total = total + count_ones(bits);
    return !any(total > Lanes<std::int64_t, n>{most});
}

// Calls body(context, objects) until each lane has had the objects, of 64 from `first` on, whose
// bits of `chosen` are 1. The others have the bits of `word`, elements of `kept` if that is a table.
template <Index first, int n, class R, class Choices, class Table, class Body>
RDDL_INLINE void for_own_objects(Context<Pack<n, R>>& context, Lanes<std::int64_t, n> chosen,
                                 const Choices& choices,
                                 std::type_identity_t<const Mask<n>*> kept,
                                 Lanes<std::int64_t, n> word, Table& target, Body& body) {
    using Int = Lanes<std::int64_t, n>;
    constexpr auto count = static_cast<int>(std::min<Index>(element_count<Table> - first, 64));
    for (Mask<n> some = chosen != Int{0}; any(some); some = chosen != Int{0}) {
        const Int below = wrap_sub(chosen, Int{1});
        const Int bit = chosen ^ (chosen & below);
        const Int place = count_ones(chosen ^ below) + Int{first - 1};
        Context<OwnObjectsOf<n, R>> several{context, context.active && some};
        body(several, OwnObjects<n>{first_element(choices), kept, some,
                                    select(some, place, Int{0}), bit, word});
        chosen = chosen ^ bit;
    }
    store_bits<count>(word, first_element(target) + first);
}

}  // namespace detail
}  // namespace rddl
