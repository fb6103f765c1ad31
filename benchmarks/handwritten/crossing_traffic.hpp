// CrossingTraffic_MDP_ippc2014 10: 49 cells, two bits each; moves and the traffic are shifts.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct CrossingTraffic : RunsToTheHorizon {
    static constexpr int width = 8;
    static constexpr std::uint64_t horizon = 40;
    static constexpr bool stochastic = true;
    static constexpr int size = 7;  // cell = x * size + y
    static constexpr std::size_t cells = size * size;
    static constexpr std::uint64_t everywhere = first_bits(cells);
    static constexpr std::uint64_t first_row = 0x0000'0408'1020'4081, last_row = first_row << 6;
    static constexpr std::uint64_t first_column = first_bits(size),
                                   last_column = first_column << 42;
    static constexpr std::uint64_t entries = last_column & ~first_row & ~last_row;

    template <class L>
    struct State {
        typename L::Word robot, obstacles;
    };
    template <class L>
    struct Actions {
        FourBools<typename L::Word> move;  // north, south, east, west
    };

    static void start(State<rddl::Scalar>& state) {
        state = {crossing_traffic::robot[0], crossing_traffic::obstacles[0]};
    }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        state = {select(where, crossing_traffic::robot[0], state.robot),
                 select(where, crossing_traffic::obstacles[0], state.obstacles)};
    }

    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        load_four_bools(actions.move, records);
    }

    // Cells whose next value has been decided, and where it is true.
    template <class Word>
    struct Decided {
        Word cells, robot;

        // Robots leave the cells `from`; those that are hit by no obstacle reach `to`.
        void move(const Word& wanted, const Word& from, const Word& to) {
            const Word open = wanted ^ (wanted & cells);
            robot = robot | (open & to);
            cells = cells | (open & (from | to));
        }
    };

    static constexpr Thresholds inputs = [] {
        Thresholds all;
        all.of.fill(threshold(crossing_traffic::input_rate));
        return all;
    }();

    template <class L, class Draws>
    static typename L::Real step(State<L>& state, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        const Word robot = state.robot, obstacles = state.obstacles;
        const Word safe = robot ^ (robot & obstacles);
        const Word none{std::uint64_t{0}};
        Decided<Word> next{none, none};
        const auto& [north, south, east, west] = actions.move;
        next.move(north, robot & ~last_row, (safe & ~last_row) << 1);
        next.move(south, robot & ~first_row, (safe & ~first_row) >> 1);
        next.move(east, robot & ~last_column, (safe & ~last_column) << size);
        next.move(west, robot & ~first_column, (safe & ~first_column) >> size);
        const Word moved = next.robot | (safe ^ (safe & next.cells));
        const Word there = robot & crossing_traffic::goal[0];
        state.robot = if_zero(there, moved, there);

        const auto [enters] = draw_bits<cells>(draws, 0, Word{entries}, inputs);
        state.obstacles = (obstacles >> size & ~(first_row | last_row)) | (enters & entries);
        return real_of_count(bit_count(there)) - 1.0;
    }

    template <class L>
    static void store(const State<L>& state, std::int64_t lane, std::byte* record) {
        store_bits_as_bytes<cells>(lane_of(state.robot, lane), record);
        store_bits_as_bytes<cells>(lane_of(state.obstacles, lane), record + cells);
    }
};

}  // namespace handwritten
