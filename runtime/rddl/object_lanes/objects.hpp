// Several objects of one environment in vector registers.
//
// Emitted code evaluates some loops by for_each_object. Packs of environments take one object after
// the other there; one environment alone takes 16 of them at once, or 8 if no more are left: a
// value is then a pack whose lanes are neighbouring elements of tables. Each lane computes what one
// object would, bit for bit, and the reported fault is that of the first object.
#pragma once

#include <rddl/lanes/simd.hpp>
#include <rddl/lanes/simd_bytes.hpp>
#include <rddl/object_lanes/some_objects.hpp>
#include <rddl/random/random.hpp>
#include <rddl/values/bits.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/few_objects.hpp>
#include <rddl/values/few_words.hpp>
#include <rddl/values/pack_ops.hpp>
#include <rddl/values/reductions.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace rddl {

// Named after the level of simd.hpp, as packs are.
inline namespace RDDL_SIMD_LEVEL {

// A lane type: the values of n objects.
template <int n, class R>
struct Objects : Pack<n, R> {};

// One object, as the row-major place of its elements in tables.
struct OneObject {
    Index place;
    constexpr operator Index() const { return place; }
};
// The place where their values are stored.
template <class T, int n>
struct Elements {
    T* first;
    SomeObjects<n> objects;
    template <class Value>
    RDDL_INLINE void operator=(const Value& values) const;
};

}  // namespace RDDL_SIMD_LEVEL

// One or two registers of doubles with AVX-512, half a register of floats or one: no more than the
// objects need.
inline constexpr int objects_at_once = 16;
template <Index count>
inline constexpr int objects_of_loop =
    count <= objects_at_once / 2 ? objects_at_once / 2 : objects_at_once;

// ------------------------------------------------------------------------------------ draws

// The standard normals that a loop has drawn last, of one series and the indices from `first` on.
struct NormalsOfSeries {
    using Some = Lanes<double, objects_at_once>;
    static constexpr std::uint32_t most = Context<Pack<objects_at_once>>::most_numbers;

    std::uint32_t series = no_series;
    std::uint32_t first, count;  // of packs
    Some packs[most];
    NormalsOfSeries() {}  // leaves the numbers as they are, to be quick

    std::uint32_t pack_of(Place place) const { return (place.index - first) / objects_at_once; }
    bool has(Place place) const { return series == place.series && pack_of(place) < count; }
    // A series is kept until the loop ends: so the series of a loop do not drive each other out.
    bool may_keep(Place place) const { return series == no_series || series == place.series; }
};
struct NormalsOfLoop {
    std::array<NormalsOfSeries, recent_series> kept;

    NormalsOfSeries& of(Place place) { return kept[place.series % recent_series]; }
};

template <int n, class R>
struct Context<Objects<n, R>> {
    const StepDraws& draws;
    Mask<n> active;                    // the lanes whose values are used: they alone can fault
    NormalsOfLoop* normals = nullptr;  // null: none are kept
    int faulty_lane = n;
    FaultRecord fault{};  // of the first of the lanes that have one

    // Compilers keep what a call is given in memory. So the call in the rare branch gets a copy of
    // the value, and neither the context nor what it refers to.
    template <class Value>
    RDDL_INLINE Mask<n> require(Mask<n> ok, FaultKind kind, Place place, const Value& value) {
        const Mask<n> failed = active && !ok;
        if (any(failed)) [[unlikely]] {
            const int lane = __builtin_ctzll(failed.bits);
            if (lane < faulty_lane) {
                const Value copy = value;
                place.index += static_cast<std::uint32_t>(lane);
                fault = {kind, place, value_in(copy, lane)};
                faulty_lane = lane;
            }
        }
        return ok;
    }

  private:
    template <class Value>
    [[gnu::noinline, gnu::cold]] static double value_in(const Value& values, int lane) {
        return get_lane(values, lane);
    }
};

// Lanes without an object may have any.
template <int n, class R>
RDDL_INLINE Lanes<std::int64_t, n> in_range(const Context<Objects<n, R>>& context,
                                            const Lanes<std::int64_t, n>& index) {
    return select(context.active, index, Lanes<std::int64_t, n>{0});
}

// Lane k draws for the object k places behind that of lane 0, whose place is even: the numbers of a
// counter value are those of two neighbours.
template <int n, class R>
RDDL_INLINE Lanes<R, n> uniform_at(Context<Objects<n, R>>& context, Place place) {
    using Word = WordsFor<n / 2>;
    if (context.draws.are_medians) return Lanes<R, n>{R(median_number)};
    const Word first{std::uint64_t{place.index / 2}};
    philox::Block<Word> words;
    context.draws.schedule.generate(
        place.series, first + Word::load(detail::lane_numbers<Word::width>.data()), words);
    const auto numbers = unit_real<R>(
        interleaved(join_lower_halves(words[0], words[1]), join_lower_halves(words[2], words[3])));
    return part_of<Lanes<R, n>>(numbers, 0);
}

// Two objects share one counter value, which is made outside of vector registers sooner.
template <int n, class R, std::same_as<PlaceAmong<2>> AmongTwo>
RDDL_INLINE Lanes<R, n> uniform_at(Context<Objects<n, R>>& context, AmongTwo place) {
    if (context.draws.are_medians) return Lanes<R, n>{R(median_number)};
    philox::Block<std::uint64_t> words;
    context.draws.schedule.generate(place.series, std::uint64_t{place.index / 2}, words);
    Lanes<R, n> numbers{unit_real<R>(words[2], words[3])};
    numbers.set(0, unit_real<R>(words[0], words[1]));
    return numbers;
}

namespace detail {

// The normals of the next objects of a loop over `count`, as many as are kept.
template <class Normal>
[[gnu::noinline]] void refill(NormalsOfSeries& normals, const StepDraws& draws, Place place,
                              std::uint32_t count) {
    Context<Objects<objects_at_once, double>> context{draws, true};
    normals.series = place.series;
    normals.first = place.index;
    normals.count = 0;
    for (; normals.count < normals.most && place.index < count; place.index += objects_at_once)
        normals.packs[normals.count++] = uniform_at(context, place);
    Normal::template replace<NormalsOfSeries::most>(normals.packs, normals.count);
}

}  // namespace detail

// Normals of a loop over more objects than lanes are made together, since few of them are far from
// the median, and these take long. Where most lanes need none, or another series is kept, they are
// made of these lanes alone.
template <class Normal, int n, Index count>
requires(count > objects_at_once && ReplacesSeveral<Normal, NormalsOfSeries::Some>)
    RDDL_INLINE Lanes<double, n> standard_at(Context<Objects<n, double>>& context,
                                             PlaceAmong<count> place) {
    if (!context.normals) return Normal::of(uniform_at(context, place));
    NormalsOfSeries& normals = context.normals->of(place);
    if (!normals.has(place)) {
        if (!normals.may_keep(place) || 2 * __builtin_popcountll(context.active.bits) < n)
            return Normal::of(uniform_at(context, place));
        detail::refill<Normal>(normals, context.draws, place, count);
    }
    return part_of<Lanes<double, n>>(normals.packs[normals.pack_of(place)], 0);
}

// --------------------------------------------------------------------------------- elements

namespace detail {

// The dimensions of nested arrays.
template <class T>
inline constexpr std::size_t rank = 0;
template <class T, std::size_t n>
inline constexpr std::size_t rank<std::array<T, n>> = 1 + rank<T>;

// The first of the parts of nested arrays that have m dimensions.
template <std::size_t m, class T>
constexpr auto& first_part(T& table) {
    if constexpr (rank<std::remove_const_t<T>> == m)
        return table;
    else
        return first_part<m>(table[0]);
}

}  // namespace detail

// The element of an object, in a table whose dimensions are those of the loops around it, or whose
// first ones are.
template <class Table>
RDDL_INLINE const auto& at(const Table& table, OneObject object) {
    return (&detail::first_part<0>(table))[object.place];
}
template <class Table, class... Indices>
requires(sizeof...(Indices) > 0)  //
    RDDL_INLINE auto at(const Table& table, OneObject object, const Indices&... indices) {
    return at((&detail::first_part<sizeof...(Indices)>(table))[object.place], indices...);
}

template <class Table, int n>
RDDL_INLINE auto at(const Table& table, const SomeObjects<n>& objects) {
    return detail::load_some(&detail::first_part<0>(table) + objects.first, objects);
}
template <class Table, int n, class... Indices>
requires(sizeof...(Indices) > 0)  //
    RDDL_INLINE
    auto at(const Table& table, const SomeObjects<n>& objects, const Indices&... indices) {
    using Int = Lanes<std::int64_t, n>;
    using Row = std::remove_cvref_t<decltype(detail::first_part<sizeof...(Indices)>(table))>;
    const auto lane_numbers = Lanes<std::uint64_t, n>::load(detail::lane_numbers<n>.data());
    const Int rows = Int{objects.first} + ints_of(lane_numbers);
    const Int places =
        rows * Int{detail::Nested<Row>::count} + detail::place_in<Row, Int>(indices...);
    return detail::gather<detail::Nested<Table>::count>(&detail::first_part<0>(table),
                                                        select(objects.mask(), places, Int{0}));
}

// The element that each object chooses from the table by indices of its own.
template <class Table, class... Indices>
RDDL_INLINE auto at_own(const Table& table, OneObject, const Indices&... indices) {
    return at(table, indices...);
}
template <class Table, int n, class... Indices>
RDDL_INLINE auto at_own(const Table& table, const SomeObjects<n>& objects,
                        const Indices&... indices) {
    using Int = Lanes<std::int64_t, n>;
    const Int places = detail::place_in<Table, Int>(indices...);
    return detail::gather<detail::Nested<Table>::count>(&detail::first_part<0>(table),
                                                        select(objects.mask(), places, Int{0}));
}

// The elements of a table of bools at places that each object has in another table, or in a row of
// it.
template <const auto& places, class Table, class... Row>
RDDL_INLINE const auto& at_places(const Table& table, OneObject object, const Row&... row) {
    const auto& own = detail::row_of(places, row...);
    return (&detail::first_part<0>(table))[(&detail::first_part<0>(own))[object.place]];
}
template <const auto& places, class Table, int n, class... Row>
RDDL_INLINE Mask<n> at_places(const Table& table, const SomeObjects<n>& objects,
                              const Row&... row) {
    constexpr std::int64_t size = detail::Nested<Table>::count;
    const auto& own = detail::row_of(places, row...);
    return Mask<n>::of_bits(simd::bits_of_chosen_bytes<size>(
        &detail::first_part<0>(table), &detail::first_part<0>(own) + objects.first, objects.count));
}

// The elements in which values are stored.
template <class Table>
RDDL_INLINE auto& elements(Table& table, OneObject object) {
    return (&detail::first_part<0>(table))[object.place];
}
template <class Table, int n>
RDDL_INLINE auto elements(Table& table, const SomeObjects<n>& objects) {
    auto* const first = &detail::first_part<0>(table) + objects.first;
    return Elements<std::remove_pointer_t<decltype(first)>, n>{first, objects};
}

template <class T, int n>
template <class Value>
RDDL_INLINE void Elements<T, n>::operator=(const Value& values) const {
    detail::store_some(first, objects, LanesOf<Value, n>(values));
}

// ----------------------------------------------------------------------------- aggregations

// Aggregations (reductions.hpp) of each object by itself, whose terms may differ between objects.
namespace detail {

template <class L, class Body>
using TermsOf = LanesOf<std::remove_cvref_t<std::invoke_result_t<Body&, Index>>, L::width>;

}  // namespace detail

template <class L, class Body>
RDDL_INLINE auto sum(const Context<L>&, IndexRange range, Body&& body) {
    return sum<detail::TermsOf<L, Body>>(range, body);
}
template <class L, class Body>
RDDL_INLINE auto product(const Context<L>&, IndexRange range, Body&& body) {
    return product<detail::TermsOf<L, Body>>(range, body);
}
template <class L, class Body>
RDDL_INLINE auto minimum_over(const Context<L>&, Index count, Body&& body) {
    return minimum_over<detail::TermsOf<L, Body>>(count, body);
}
template <class L, class Body>
RDDL_INLINE auto maximum_over(const Context<L>&, Index count, Body&& body) {
    return maximum_over<detail::TermsOf<L, Body>>(count, body);
}
template <class L, class Body>
RDDL_INLINE auto for_all(const Context<L>&, IndexRange range, Body&& body) {
    return for_all<detail::TermsOf<L, Body>>(range, body);
}
template <class L, class Body>
RDDL_INLINE auto exists(const Context<L>&, IndexRange range, Body&& body) {
    return exists<detail::TermsOf<L, Body>>(range, body);
}

// ------------------------------------------------------------------------------------ loops

namespace detail {

template <int n, class R, class Body>
RDDL_INLINE void for_some(Context<ScalarOf<R>>& context, const StepDraws& draws,
                          NormalsOfLoop& normals, const SomeObjects<n>& objects, Body& body) {
    Context<Objects<n, R>> some{draws, objects.mask(), &normals};
    body(some, objects);
    if (some.fault && !context.fault) context.fault = some.fault;
}
// Two calls let compilers know how many objects there are in each, and let the last ones take no
// more registers than they need.
template <int n, Index count, class R, class Body>
RDDL_ALWAYS_INLINE void for_each_of_several(Context<ScalarOf<R>>& context, Body&& body) {
    constexpr Index full = count / n * n;
    constexpr int rest = count - full, most = std::min(n, objects_of_loop<rest>);
    const StepDraws draws(context);
    NormalsOfLoop normals;
    for (Index first = 0; first < full; first += n)
        for_some(context, draws, normals, SomeObjects<n>{first, n}, body);
    if constexpr (rest > 0) for_some(context, draws, normals, SomeObjects<most>{full, rest}, body);
}

}  // namespace detail

// Calls body(context, object) for [0, count): for a context of these objects.
template <Index count, int n, class R, class Body>
RDDL_INLINE void for_each_object(Context<Pack<n, R>>& context, Body&& body) {
    for (Index i = 0; i < count; ++i) body(context, OneObject{i});
}
template <Index count, class R, class Body>
RDDL_INLINE void for_each_object(Context<ScalarOf<R>>& context, Body&& body) {
    detail::for_each_of_several<objects_of_loop<count>, count>(context, body);
}

// The same for few objects whose values are reals: half a register of AVX-512 has four doubles.
template <Index count, class L, class Body>
RDDL_INLINE void for_few_reals(Context<L>& context, Body&& body) {
    if constexpr (std::is_same_v<L, Scalar>)
        detail::for_each_of_several<int{most_few_reals}, count>(context, body);
    else
        for_each_object<count>(context, body);
}

// The same for few objects whose bodies look at few bits (rddl/values/few_bits.hpp): in packs, the
// places of these are known where the loop is unrolled.
template <Index count, int n, class R, class Body>
RDDL_INLINE void for_few_objects(Context<Pack<n, R>>& context, Body&& body) {
    static_assert(count <= most_few_objects);
#ifdef __GNUC__
#pragma GCC unroll most_few_objects
#endif
    for (Index i = 0; i < count; ++i) body(context, OneObject{i});
}
template <Index count, class R, class Body>
RDDL_INLINE void for_few_objects(Context<ScalarOf<R>>& context, Body&& body) {
    for_each_object<count>(context, body);
}

// Whether body(context, object), which neither faults nor draws, holds for one object at least of
// [0, count), or for all. One environment takes a register of reals at once, since masks of several
// registers have to be joined.
template <Index count, int n, class R, class Body>
RDDL_INLINE Mask<n> exists_object(Context<Pack<n, R>>& context, Body&& body) {
    Mask<n> found{false};
    for (Index i = 0; i < count; ++i) found = found || body(context, OneObject{i});
    return found;
}
template <Index count, class R, class Body>
RDDL_INLINE bool exists_object(Context<ScalarOf<R>>& context, Body&& body) {
    bool found = false;
    detail::for_each_of_several<std::max(objects_at_once / 2, simd::lanes_of<R>), count>(
        context, [&]<int n>(auto& several, const SomeObjects<n>& objects) RDDL_INLINE_LAMBDA {
            const Mask<n> holds = body(several, objects);
            found |= any(holds && objects.mask());
        });
    return found;
}
template <Index count, class L, class Body>
RDDL_INLINE auto for_all_objects(Context<L>& context, Body&& body) {
    return !exists_object<count>(context,
                                 [&](auto& several, const auto& object)
                                     RDDL_INLINE_LAMBDA { return !body(several, object); });
}

}  // namespace rddl
