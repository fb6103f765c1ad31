// Loops over bools that follow the only true bool of a table: where it goes is looked up.
#pragma once

#include <rddl/lanes/pack.hpp>
#include <rddl/lanes/simd_bytes.hpp>
#include <rddl/object_lanes/chosen_objects.hpp>
#include <rddl/object_lanes/objects.hpp>
#include <rddl/values/bits.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/move_codes.hpp>
#include <rddl/values/tables.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>

namespace rddl {

namespace detail {

// The place of the only bit that is 1; -1 where there are several.
template <std::size_t n>
RDDL_INLINE Index only_one_of(const std::array<std::uint64_t, n>& words) {
    if (count_ones_of(words) != 1) return -1;
    Index place = 0;
    Index first = 0;
    for (const std::uint64_t bits : words) {
        place = bits != 0 ? first + __builtin_ctzll(bits) : place;
        first += 64;
    }
    return place;
}

// The first one is the lowest bit.
template <class... Choices>
RDDL_INLINE Index bits_of_choices(const std::tuple<Choices...>& choices) {
    return [&]<std::size_t... bit>(std::index_sequence<bit...>) RDDL_INLINE_LAMBDA {
        return (Index{0} | ... | (Index{std::get<bit>(choices)} << bit));
    }
    (std::index_sequence_for<Choices...>());
}

}  // namespace detail

// Fills `target` with what `moves`, a constant table of MoveCodes, has for the place of the only
// true bool of `few` and the bits of the choices. draw(context, object) draws a bool, and nothing
// is true where nothing was. In packs, and where several are true or a code says so,
// otherwise(context) fills it.
template <const auto& moves, int lanes, class R, class Few, class Choices, class Table, class Draw,
          class Otherwise>
RDDL_INLINE void move_only_true(Context<Pack<lanes, R>>& context, const Few&, const Choices&,
                                Table&, Draw&&, Otherwise&& otherwise) {
    otherwise(context);
}
template <const auto& moves, class R, class Few, class Choices, class Table, class Draw,
          class Otherwise>
RDDL_INLINE void move_only_true(Context<ScalarOf<R>>& context, const Few& few,
                                const Choices& choices, Table& target, Draw&& draw,
                                Otherwise&& otherwise) {
    constexpr Index count = detail::element_count<Table>;
    constexpr MoveCodes codes{count};
    simd::clear_bytes<static_cast<int>(count)>(detail::first_element(target));
    if (!is_any_true(few)) return;
    const Index place = detail::only_one_of(words_of(few));
    Index code = codes.other();
    if (place >= 0) [[likely]]
        code =
            element(moves, place << std::tuple_size_v<Choices> | detail::bits_of_choices(choices));
    if (code < codes.none()) [[likely]] {
        Context<ChosenOf<R>> alone{context};
        const Index object = code < count ? code : code - count;
        detail::first_element(target)[object] = code < count || draw(alone, OneObject{object});
    } else if (code == codes.other()) {
        // A call of its own, with a context of its own, which leaves registers to the step.
        Context<ScalarOf<R>> its_context = context;
        [&]() __attribute__((noinline, cold)) {
            otherwise(its_context);
        }
        ();
        context = its_context;
    }
}

}  // namespace rddl
