// Bools of objects that a step meets only where its numbers come near to them.
//
// A grid over the places of numbers knows for each cell how far the other numbers of a step, its
// moves, may be from 0 so that no object matters: the clearance, as maps for motion planning have
// it. The compiler has proved it (passes/lanes/tabulate_clearances.hpp). All else is near.
#pragma once

#include <rddl/object_lanes/objects.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>

namespace rddl {

// As many cells in each dimension, of one width.
template <std::size_t dimensions, class R = double>
struct Grid {
    std::array<R, dimensions> begin, cells_per_unit;
    R clearance_unit;  // the clearances are multiples of it
    R least_move;      // a move that is nearer to 0 has no clearance
};

namespace detail {

template <const auto& clearances>
RDDL_INLINE std::int64_t clearance_of(std::int64_t cell) {
    return (&first_part<0>(clearances))[cell];
}
template <const auto& clearances, int n>
RDDL_INLINE Lanes<std::int64_t, n> clearance_of(const Lanes<std::int64_t, n>& cell) {
    constexpr std::int64_t count = Nested<std::remove_cvref_t<decltype(clearances)>>::count;
    return Lanes<std::int64_t, n>::each(
        [](simd::Ints place) RDDL_INLINE_LAMBDA {
            const auto bytes = simd::gather_bytes<count>(&first_part<0>(clearances), place);
            return (simd::Ints)(bytes & 0xFF);
        },
        cell);
}

template <class R, class Int>
RDDL_INLINE auto real_of(const Int& a) {
    if constexpr (std::is_same_v<R, float>)
        return to_float(a);
    else
        return to_real(a);
}

// Whether objects may matter at the place: a bool, or one for each lane.
template <const auto& clearances, class R, class Real, std::size_t dimensions, std::size_t moves>
RDDL_INLINE auto is_near(const Grid<dimensions, R>& grid, const std::array<Real, dimensions>& place,
                         const std::array<Real, moves>& move) {
    constexpr auto cells = static_cast<std::int64_t>(clearances.size());
    using Int = decltype(truncate_to_int(place[0]));
    auto is_clear = place[0] == place[0];
    Int cell{0};
    for (std::size_t k = 0; k < dimensions; ++k) {
        const Real at = (place[k] - grid.begin[k]) * grid.cells_per_unit[k];
        const auto is_inside = at >= R{0} && at < static_cast<R>(cells);
        cell = cell * Int{cells} + truncate_to_int(select(is_inside, at, Real{0}));
        is_clear = is_clear && is_inside;
    }
    const Real clearance = real_of<R>(clearance_of<clearances>(cell)) * grid.clearance_unit;
    if constexpr (moves == 0) is_clear = is_clear && clearance > R{0};
    for (const Real& each : move) {
        const Real distance = absolute(each);
        is_clear = is_clear && distance < clearance && distance >= grid.least_move;
    }
    return !is_clear;
}

// Looks at the objects of one environment, several at once.
template <Index count, class R, class Place, class Move, class Body>
RDDL_INLINE bool exists_here(Context<ScalarOf<R>>& context, const Place& place, const Move& move,
                             Body& body) {
    return std::apply(
        [&](const auto&... numbers) RDDL_INLINE_LAMBDA {
            return exists_object<count>(
                context, [&](auto& several, const auto& objects)
                             RDDL_INLINE_LAMBDA { return body(several, objects, numbers...); });
        },
        std::tuple_cat(place, move));
}

}  // namespace detail

// Whether body(context, object, places..., moves...), which neither faults nor draws, holds for one
// object at least of [0, count). Environments of a pack that are near are looked at one by one.
template <Index count, const auto& clearances, class R, std::size_t dimensions, std::size_t moves,
          class Body>
RDDL_INLINE bool exists_near_object(Context<ScalarOf<R>>& context, const Grid<dimensions, R>& grid,
                                    const std::array<R, dimensions>& place,
                                    const std::array<R, moves>& move, Body&& body) {
    if (!detail::is_near<clearances>(grid, place, move)) return false;
    return detail::exists_here<count>(context, place, move, body);
}
template <Index count, const auto& clearances, int n, class R, std::size_t dimensions,
          std::size_t moves, class Body>
RDDL_INLINE Mask<n> exists_near_object(Context<Pack<n, R>>& context,
                                       const Grid<dimensions, R>& grid,
                                       const std::array<Lanes<R, n>, dimensions>& place,
                                       const std::array<Lanes<R, n>, moves>& move, Body&& body) {
    Mask<n> found{false};
    const Mask<n> near = detail::is_near<clearances>(grid, place, move) && context.active;
    for_each_lane(near, [&](int lane) {
        auto one = Context<ScalarOf<R>>::of(0, 0, 0, true);
        std::array<R, dimensions> its_place;
        for (std::size_t k = 0; k < dimensions; ++k) its_place[k] = get_lane(place[k], lane);
        std::array<R, moves> its_move;
        for (std::size_t k = 0; k < moves; ++k) its_move[k] = get_lane(move[k], lane);
        const bool exists = detail::exists_here<count>(one, its_place, its_move, body);
        found.bits |= static_cast<decltype(found.bits)>(std::uint64_t{exists} << lane);
    });
    return found;
}

}  // namespace rddl
