// Loops over objects whose values are bools alone, which lie in registers (many_bools.hpp).
//
// Emitted code runs them by for_many_objects, for one environment and for packs. Nothing in them
// jumps: both branches of a condition are evaluated, and draws look for themselves which objects
// need them.
#pragma once

#include <rddl/object_lanes/chances.hpp>
#include <rddl/object_lanes/many_bools.hpp>
#include <rddl/object_lanes/objects.hpp>
#include <rddl/random/random.hpp>
#include <rddl/values/bits.hpp>
#include <rddl/values/tables.hpp>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace rddl {

// Named after the level of simd.hpp, as packs are.
inline namespace RDDL_SIMD_LEVEL {

// The objects [first, first + n), in environments of lane type L.
template <int n, class L>
struct ManyObjects {
    Index first;
    constexpr operator Index() const { return first; }
};
// The lane type of a loop over them.
template <int n, class L>
struct BoolsOfMany {
    static constexpr int width = n;
    using Bool = ManyBools<typename L::Bool, n>;
};

// The place where their bools are stored.
template <class Bool, int n>
struct ElementsOfMany {
    Bool* first;
    RDDL_INLINE void operator=(const ManyBools<Bool, n>& values) const {
        store_many(values, first);
    }
};
// The reals of many objects: those that are wanted are loaded.
template <class R>
struct RealsInMemory {
    const R* first;
};

}  // namespace RDDL_SIMD_LEVEL

template <int n, class L>
struct Context<BoolsOfMany<n, L>> {
    Context<L>& environments;
    ManyBools<typename L::Bool, n> active;  // the objects, and environments, whose values are used
};

// ---------------------------------------------------------------------------- aggregations

// Each object aggregates by itself, as in objects.hpp. The terms are registers.
template <int n, class L, class Body>
RDDL_INLINE auto exists(const Context<BoolsOfMany<n, L>>&, IndexRange range, Body&& body) {
    using Many = ManyBools<typename L::Bool, n>;
    Many any(false);
    for (Index i = range.begin; i < range.end; ++i) any = any || Many(body(i));
    return any;
}
template <int n, class L, class Body>
RDDL_INLINE auto for_all(const Context<BoolsOfMany<n, L>>&, IndexRange range, Body&& body) {
    using Many = ManyBools<typename L::Bool, n>;
    Many all(true);
    for (Index i = range.begin; i < range.end; ++i) all = all && Many(body(i));
    return all;
}

// --------------------------------------------------------------------------------- elements

template <class Table, int n, class L>
RDDL_INLINE auto at(const Table& table, const ManyObjects<n, L>& objects) {
    const auto* const first = &detail::first_part<0>(table) + objects.first;
    using Element = std::remove_cvref_t<decltype(*first)>;
    if constexpr (std::is_floating_point_v<Element>)
        return RealsInMemory<Element>{first};
    else if constexpr (std::is_same_v<Element, bool>)
        return spread_many<typename L::Bool, n>(first);
    else
        return load_many<n>(first);
}
// By a row of places.
template <const auto& places, class Table, int n, class L, class... Row>
requires(sizeof...(Row) > 0)  //
    RDDL_INLINE
    auto at_places(const Table& table, const ManyObjects<n, L>& objects, const Row&... row) {
    return choose_many<n, detail::Nested<Table>::count>(
        &detail::first_part<0>(table),
        &detail::first_part<0>(detail::row_of(places, row...)) + objects.first);
}
template <const auto& places, class Table, int n, class L>
RDDL_INLINE auto at_places(const Table& table, const ManyObjects<n, L>& objects) {
    using Many = ManyBools<typename L::Bool, n>;
    const auto* const elements = &detail::first_part<0>(table);
    const auto* const first = &detail::first_part<0>(places) + objects.first;
    constexpr auto place_count = detail::Nested<std::remove_cvref_t<decltype(places)>>::count;
    constexpr bool are_few = place_count <= most_places_in_lines;
    if constexpr (L::width == 1 && chooses_by_parts && place_count == n && n > bytes_of_few)
        return choose_many_by_parts<places, detail::Nested<Table>::count, n>(elements);
    else if constexpr (L::width == 1 || !are_few)
        return choose_many<n, detail::Nested<Table>::count>(elements, first);
    else
        return choose_many<n, detail::Nested<Table>::count>(
            elements, first,
            lines_of_places<places, Many::part_width>.data() + objects.first / Many::part_width);
}
template <const auto& table, int n, class L>
RDDL_INLINE auto chances(const ManyObjects<n, L>& objects) {
    return ChancesOfMany<table>{objects.first};
}
template <class Table, int n, class L>
RDDL_INLINE auto elements(Table& table, const ManyObjects<n, L>& objects) {
    return ElementsOfMany<typename L::Bool, n>{&detail::first_part<0>(table) + objects.first};
}

// ---------------------------------------------------------------------------------- choices

template <class Condition, class A, class B>
requires(is_many_bools<Condition> || is_many_bools<A> || is_many_bools<B>)  //
    RDDL_INLINE auto select(const Condition& condition, const A& a, const B& b) {
    using Many = std::conditional_t<is_many_bools<Condition>, Condition,
                                    std::conditional_t<is_many_bools<A>, A, B>>;
    return Many::select(condition, a, b);
}

template <class Bool, int n, std::invocable Then, class Else>
RDDL_INLINE auto branch(const ManyBools<Bool, n>& condition, Then&& then_value, Else&& else_value) {
    return select(condition, then_value(), else_value());
}
template <int n, class L, class Condition, class Then, class Else>
RDDL_INLINE auto branch(Context<BoolsOfMany<n, L>>& context, const Condition& condition,
                        Then&& then_value, Else&& else_value) {
    using Many = ManyBools<typename L::Bool, n>;
    const Many active = context.active, chosen = condition;
    context.active = active && chosen;
    const Many a = then_value();
    context.active = active && !chosen;
    const Many b = else_value();
    context.active = active;
    return select(chosen, a, b);
}
// Chains of else-ifs (ops.hpp), which compilers would else call with all registers in memory.
template <class Bool, int n, std::invocable Then, class Next, class... Rest>
requires(sizeof...(Rest) >= 2)  //
    RDDL_INLINE auto branch(const ManyBools<Bool, n>& condition, Then&& then_value, Next&& next,
                            Rest&&... rest) {
    return branch(condition, then_value,
                  [&]() RDDL_INLINE_LAMBDA { return branch(next(), rest...); });
}
template <int n, class L, class Condition, class Then, class Next, class... Rest>
requires(sizeof...(Rest) >= 2)  //
    RDDL_INLINE auto branch(Context<BoolsOfMany<n, L>>& context, const Condition& condition,
                            Then&& then_value, Next&& next, Rest&&... rest) {
    return branch(context, condition, then_value,
                  [&]() RDDL_INLINE_LAMBDA { return branch(context, next(), rest...); });
}

// ------------------------------------------------------------------------------------ draws

namespace detail {

template <class R>
RDDL_INLINE R reals_of(R everywhere, const SomeObjects<objects_at_once>&) {
    return everywhere;
}
template <class R>
RDDL_INLINE auto reals_of(const RealsInMemory<R>& reals,
                          const SomeObjects<objects_at_once>& objects) {
    return load_some(reals.first + objects.first, objects);
}
template <class Real>
RDDL_INLINE const Real& real_of(const Real& everywhere, int) {
    return everywhere;
}
template <class R>
RDDL_INLINE R real_of(const RealsInMemory<R>& reals, int object) {
    return reals.first[object];
}
template <const auto& table>
RDDL_INLINE auto in_memory(const ChancesOfMany<table>& chances) {
    return RealsInMemory<RealOf<table>>{&first_part<0>(table) + chances.first};
}
template <class Real>
RDDL_INLINE const Real& in_memory(const Real& reals) {
    return reals;
}

// Whether the numbers of n objects are made for the pairs that need them.
template <class Probability, int n>
inline constexpr bool are_by_pairs = false;
template <const auto& table, int n>
inline constexpr bool are_by_pairs<ChancesOfMany<table>, n> = count_of<table> == n;

// Which of 64 objects of one environment, from `first` on, draw a number below p: of those that are
// wanted. The numbers are made for 16 neighbours at once.
template <class R, class Probability>
RDDL_INLINE std::uint64_t drawn_bits(const Context<ScalarOf<R>>& context, Place place, int first,
                                     std::uint64_t wanted, const Probability& p) {
    const StepDraws draws(context);
    std::uint64_t drawn = 0;
    for (int k = 0; k < 64; k += objects_at_once) {
        const auto some = Mask<objects_at_once>::of_bits(wanted >> k);
        if (!any(some)) continue;
        const SomeObjects<objects_at_once> objects{first + k, 64 - __builtin_clzll(some.bits)};
        Context<Objects<objects_at_once, R>> drawing{draws, some};
        const Place of_first(place.site, place.index + first + k, place.series);
        const Mask<objects_at_once> below = uniform_at(drawing, of_first) < reals_of(p, objects);
        drawn |= std::uint64_t{(below && some).bits} << k;
    }
    return drawn;
}

template <class R, int n, class Probability>
RDDL_INLINE ManyBools<bool, n> drawn(Context<ScalarOf<R>>& context, Place place,
                                     const ManyBools<bool, n>& wanted, const Probability& p) {
    using Many = ManyBools<bool, n>;
    constexpr int words = (n + 63) / 64;
    std::array<std::uint64_t, words> bits{};
    Many::for_each_part([&]<int part, int count>() RDDL_INLINE_LAMBDA {
        constexpr int first = part * Many::part_width;
        const std::uint64_t there = ~std::uint64_t{0} >> (64 - count);
        bits[first / 64] |= (simd::nonzero_bytes(wanted.part[part]) & there) << first % 64;
    });
    if constexpr (are_by_pairs<Probability, n>) {
        bits = drawn_by_pairs(context, place, p, bits);
    } else {
        for (std::size_t w = 0; w < words; ++w)
            if (bits[w] != 0)
                bits[w] =
                    drawn_bits(context, place, static_cast<int>(64 * w), bits[w], in_memory(p));
    }
    return Many::of_parts([&]<int part, int>() RDDL_INLINE_LAMBDA {
        constexpr int first = part * Many::part_width;
        return simd::bytes_for_bits<typename Many::Vector>(bits[first / 64] >> first % 64);
    });
}

// Mostly few objects of a register draw, or none: then one test serves all of them.
template <int lanes, class R, int n, class Probability>
RDDL_INLINE ManyBools<Mask<lanes>, n> drawn(Context<Pack<lanes, R>>& context, Place place,
                                            const ManyBools<Mask<lanes>, n>& wanted,
                                            const Probability& p) {
    if (!any_of_many(wanted)) return wanted;
    std::array<Mask<lanes>, static_cast<std::size_t>(n)> masks;
    store_many(wanted, masks.data());
    for (int k = 0; k < n; ++k) {
        Mask<lanes>& mask = masks[static_cast<std::size_t>(k)];
        if (!any(mask)) continue;
        const Place of_object(place.site, place.index + k, place.series);
        mask = uniform_below(context, of_object, mask, real_of(in_memory(p), k));
    }
    return load_many<n>(masks.data());
}
template <int lanes, class R, int n, const auto& table>
requires(has_certain_chances<table>) RDDL_INLINE ManyBools<Mask<lanes>, n> drawn(
    Context<Pack<lanes, R>>& context, Place place, const ManyBools<Mask<lanes>, n>& wanted,
    const ChancesOfMany<table>& p) {
    using Many = ManyBools<Mask<lanes>, n>;
    const Many random = spread_many<Mask<lanes>, n>(random_objects<table>.data() + p.first);
    const Many always = spread_many<Mask<lanes>, n>(always_drawn<table>.data() + p.first);
    return drawn(context, place, wanted && random, in_memory(p)) || (wanted && always);
}

}  // namespace detail

// Draws are made where they are wanted; elsewhere they have any value, which branches leave out.
// The compiler knows that p is a probability.
namespace sample {

template <int n, class L, class Probability>
RDDL_INLINE auto bernoulli(Context<BoolsOfMany<n, L>>& context, Place place, const Probability& p) {
    return rddl::detail::drawn(context.environments, place, context.active, p);
}
template <int n, class L, class Probability>
RDDL_INLINE auto valid_bernoulli(Context<BoolsOfMany<n, L>>& context, Place place,
                                 const Probability& p) {
    return rddl::detail::drawn(context.environments, place, context.active, p);
}

}  // namespace sample

// ------------------------------------------------------------------------------------ loops

namespace detail {

// The objects that are in registers at once: of one environment all, unless they are very many; of
// packs as many as one register holds.
template <class Bool>
inline constexpr int most_in_registers = ManyBools<Bool, 1>::part_width;
template <>
inline constexpr int most_in_registers<bool> = 256;

template <class R>
RDDL_INLINE bool active_in(const Context<ScalarOf<R>>&) {
    return true;
}
template <int lanes, class R>
RDDL_INLINE Mask<lanes> active_in(const Context<Pack<lanes, R>>& context) {
    return context.active;
}

// All that the body calls becomes a part of it: registers are not passed between functions.
template <int n, class L, class Body>
[[gnu::flatten]] void for_these_objects(Context<L>& context, Index first, Body&& body) {
    Context<BoolsOfMany<n, L>> many{context, active_in(context)};
    body(many, ManyObjects<n, L>{first});
}

}  // namespace detail

// Calls body(context, objects) for all of [0, count). The bools of few objects of one environment
// are the bits of a mask, and packs take fewer than 8 objects, whose masks of 64 environments do
// not fill a register, one after the other.
template <Index count, class L, class Body>
RDDL_INLINE void for_many_objects(Context<L>& context, Body&& body) {
    constexpr int at_once = detail::most_in_registers<typename L::Bool>;
    constexpr int rest = static_cast<int>(count % at_once);
    constexpr Index few = L::width == 1 ? objects_at_once : 7;
    if constexpr (count <= few) {
        for_each_object<count>(context, body);
    } else {
        for (Index first = 0; first < count - rest; first += at_once)
            detail::for_these_objects<at_once>(context, first, body);
        if constexpr (rest > 0) detail::for_these_objects<rest>(context, count - rest, body);
    }
}

// The same of bodies that do not draw: registers have the bools of few objects too.
template <Index count, class L, class Body>
RDDL_INLINE void for_rows_of_bools(Context<L>& context, Body&& body) {
    if constexpr (L::width == 1 && count <= bytes_of_few) {
        Context<BoolsOfMany<count, L>> many{context, true};
        body(many, ManyObjects<count, L>{0});
    } else {
        for_many_objects<count>(context, body);
    }
}

// The same where the bools of `target` are false except for objects that read a true one of `few`:
// element i is read by objects[rows[i]] and those behind it, before objects[rows[i + 1]]. One
// environment computes those alone, unless many are true.
template <Index count, int lanes, class R, class Few, class Table, class Body>
RDDL_INLINE void for_affected_objects(Context<Pack<lanes, R>>& context, const Few&, const auto&,
                                      const auto&, Table&, Body&& body) {
    for_many_objects<count>(context, body);
}
template <Index count, class R, class Few, class Table, class Body>
RDDL_INLINE void for_affected_objects(Context<ScalarOf<R>>& context, const Few& few,
                                      const auto& rows, const auto& objects, Table& target,
                                      Body&& body) {
    constexpr int most_true = static_cast<int>(count / 16);
    assign(target, false);
    if (!is_any_true(few)) return;
    const auto words = words_of(few);
    if (detail::count_ones_of(words) > most_true) return for_many_objects<count>(context, body);
    detail::for_each_one(words, [&](Index i) RDDL_INLINE_LAMBDA {
        for (Index entry = rows[static_cast<std::size_t>(i)];
             entry < rows[static_cast<std::size_t>(i) + 1]; ++entry)
            body(context, OneObject{objects[static_cast<std::size_t>(entry)]});
    });
}

}  // namespace rddl
