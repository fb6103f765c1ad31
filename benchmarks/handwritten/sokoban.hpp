// Sokoban_arcade 0: sets of cells as the bits of a word; the walls stand all around, so that a
// move is a shift.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct Sokoban : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 10;
    static constexpr bool stochastic = false;
    static constexpr std::size_t cells = 35;
    // The distances from a cell to its neighbours: a column is as long as the room is high.
    static constexpr std::uint64_t column = 7, one = 1;

    template <class L>
    struct State {
        typename L::Word boxes, man;
    };
    // The number of a direction: left, up, right, down, none.
    template <class L>
    struct Actions {
        typename L::Word direction;
    };

    static void start(State<rddl::Scalar>& state) { state = {sokoban::boxes, sokoban::man}; }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        state.boxes = select(where, std::uint64_t{sokoban::boxes}, state.boxes);
        state.man = select(where, std::uint64_t{sokoban::man}, state.man);
    }

    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        std::memcpy(&actions.direction, record, sizeof actions.direction);
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        actions.direction = L::Word::load(reinterpret_cast<const std::uint64_t*>(records));
    }

    // The cell next to one, in a direction.
    static std::uint64_t next_to(std::uint64_t cell, std::uint64_t direction) {
        static constexpr std::uint64_t to_higher[] = {0, one, column, 0, 0};
        static constexpr std::uint64_t to_lower[] = {column, 0, 0, one, 0};
        return cell << to_higher[direction] >> to_lower[direction];
    }
    template <int n>
    static rddl::Lanes<std::uint64_t, n> next_to(const rddl::Lanes<std::uint64_t, n>& cell,
                                                 const rddl::Lanes<std::uint64_t, n>& direction) {
        const auto goes = [&](std::uint64_t where) {
            return rddl::ints_of(direction) == static_cast<std::int64_t>(where);
        };
        const auto along = select(goes(0), cell >> column, select(goes(2), cell << column, cell));
        return select(goes(1), cell << one, select(goes(3), cell >> one, along));
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws&) {
        using Word = typename L::Word;
        using Real = typename L::Real;
        const Word none{std::uint64_t{0}};
        const Word outside = s.boxes & ~std::uint64_t{sokoban::storage};
        const Word ahead = next_to(s.man, actions.direction);
        const Word beyond = next_to(ahead, actions.direction);
        const Word pushed = s.boxes & ahead;
        const Word blocked = if_zero(pushed, none, beyond & (s.boxes | Word{sokoban::walls})) |
                             (ahead & std::uint64_t{sokoban::walls});
        const Word moved = if_zero(blocked, pushed, none);
        const Word reached = if_zero(moved, none, beyond);
        s.man = if_zero(blocked, ahead, s.man);
        s.boxes = s.boxes ^ moved ^ reached;
        const Real bonus = if_any(reached & std::uint64_t{sokoban::storage}, Real{1.0}, Real{0.0}) -
                           if_any(moved & std::uint64_t{sokoban::storage}, Real{1.0}, Real{0.0});
        return if_any(outside, bonus - 0.1, Real{10.0});
    }

    static double if_any(std::uint64_t cells, double yes, double no) { return cells ? yes : no; }
    template <int n>
    static rddl::Lanes<double, n> if_any(const rddl::Lanes<std::uint64_t, n>& cells,
                                         const rddl::Lanes<double, n>& yes,
                                         const rddl::Lanes<double, n>& no) {
        return select(is_zero(cells), no, yes);
    }

    template <class L>
    static void store(const State<L>& state, std::int64_t lane, std::byte* record) {
        store_bits_as_bytes<cells>(lane_of(state.boxes, lane), record);
        store_bits_as_bytes<cells>(lane_of(state.man, lane), record + cells);
    }
};

}  // namespace handwritten
