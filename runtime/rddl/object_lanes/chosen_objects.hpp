// Loops over objects of which an action chooses few; the bools of the others stay as they are, or
// are false.
//
// In packs each environment takes its own objects (own_objects.hpp), unless one has chosen many.
// One environment computes the bools of the chosen objects alone, unless many are chosen, and keeps
// all bools as bits until they are stored: processors are slow to load in one piece what has just
// been stored in several.
#pragma once

#include <rddl/object_lanes/objects.hpp>
#include <rddl/object_lanes/own_objects.hpp>
#include <rddl/random/random.hpp>
#include <rddl/values/bits.hpp>
#include <rddl/values/context.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace rddl {

// Named after the level of simd.hpp, as packs are.
inline namespace RDDL_SIMD_LEVEL {

// A lane type: the values of one object of few.
template <class R>
struct ChosenOf : ScalarOf<R> {};

// An object whose bools are bits of words.
struct ChosenObject : OneObject {
    std::uint64_t* words;
};
// The place where its bool is stored.
struct ChosenElement {
    std::uint64_t* word;
    int bit;
    RDDL_INLINE void operator=(bool value) const {
        *word = (*word & ~(std::uint64_t{1} << bit)) | std::uint64_t{value} << bit;
    }
};

}  // namespace RDDL_SIMD_LEVEL

template <class R>
struct Context<ChosenOf<R>> {
    Context<ScalarOf<R>>& environment;

    RDDL_INLINE bool require(bool ok, FaultKind kind, Place place, double value) {
        return environment.require(ok, kind, place, value);
    }
};

// Numbers are not made for the neighbours.
template <class R>
RDDL_INLINE R uniform_at(Context<ChosenOf<R>>& context, Place place) {
    return uniform_at(context.environment, LonePlace(place.site, place.index, place.series));
}

template <class R, class Then, class Else>
RDDL_INLINE auto branch(Context<ChosenOf<R>>& context, bool condition, Then&& then_value,
                        Else&& else_value) {
    return branch(context.environment, condition, then_value, else_value);
}

template <class Table>
RDDL_INLINE ChosenElement elements(Table&, const ChosenObject& object) {
    return {object.words + object.place / 64, static_cast<int>(object.place % 64)};
}

namespace detail {

// 64 elements at a time.
template <class Table>
RDDL_INLINE void store_words(const std::uint64_t* words, Table& table) {
    constexpr int count = static_cast<int>(element_count<Table>);
    [&]<int... word>(std::integer_sequence<int, word...>) RDDL_INLINE_LAMBDA {
        (store_bits<(count - 64 * word < 64 ? count - 64 * word : 64)>(
             static_cast<std::int64_t>(words[word]), first_element(table) + 64 * word),
         ...);
    }
    (std::make_integer_sequence<int, (count + 63) / 64>());
}

}  // namespace detail

// Calls body(context, object) for [0, count). An object whose bool in `choices`, a table of the
// caller's action, is false gets its element of `kept` in `target`.
template <Index count, int n, class R, class Choices, class Table, class Body>
RDDL_INLINE void for_chosen_objects(Context<Pack<n, R>>& context, const Choices& choices,
                                    const Table& kept, Table& target, Body&& body) {
    constexpr int most_chosen = static_cast<int>(count / 8);
    constexpr std::size_t word_count = (count + 63) / 64;
    [&]<std::size_t... word>(std::index_sequence<word...>) RDDL_INLINE_LAMBDA {
        const std::array<Lanes<std::int64_t, n>, word_count> chosen{
            action_bits<Index{64 * word}>(choices)...};
        if (!detail::are_few(chosen, most_chosen)) return for_each_object<count>(context, body);
        (detail::for_own_objects<Index{64 * word}>(context, chosen[word], choices,
                                                   detail::first_element(kept),
                                                   bits<Index{64 * word}>(kept), target, body),
         ...);
    }
    (std::make_index_sequence<word_count>());
}
template <Index count, class R, class Choices, class Table, class Body>
RDDL_INLINE void for_chosen_objects(Context<ScalarOf<R>>& context, const Choices& choices,
                                    const Table& kept, Table& target, Body&& body) {
    constexpr int most_chosen = static_cast<int>(count / 8);
    const auto chosen = action_words_of(choices);
    if (detail::count_ones_of(chosen) > most_chosen) return for_each_object<count>(context, body);
    auto words = words_of(kept);
    Context<ChosenOf<R>> of_chosen{context};
    detail::for_each_one(chosen, [&](Index i) RDDL_INLINE_LAMBDA {
        body(of_chosen, ChosenObject{{i}, words.data()});
    });
    detail::store_words(words.data(), target);
}

// An object whose bool is false gets false. All objects together take no less than many of them.
template <Index count, int n, class R, class Choices, class Table, class Body>
RDDL_INLINE void for_chosen_objects(Context<Pack<n, R>>& context, const Choices& choices,
                                    Table& target, Body&& body) {
    [&]<std::size_t... word>(std::index_sequence<word...>) RDDL_INLINE_LAMBDA {
        (detail::for_own_objects<Index{64 * word}>(context, action_bits<Index{64 * word}>(choices),
                                                   choices, nullptr, Lanes<std::int64_t, n>{0},
                                                   target, body),
         ...);
    }
    (std::make_index_sequence<(count + 63) / 64>());
}
template <Index count, class R, class Choices, class Table, class Body>
RDDL_INLINE void for_chosen_objects(Context<ScalarOf<R>>& context, const Choices& choices,
                                    Table& target, Body&& body) {
    std::array<std::uint64_t, (count + 63) / 64> words{};
    Context<ChosenOf<R>> of_chosen{context};
    detail::for_each_one(action_words_of(choices), [&](Index i) RDDL_INLINE_LAMBDA {
        body(of_chosen, ChosenObject{{i}, words.data()});
    });
    detail::store_words(words.data(), target);
}

}  // namespace rddl
