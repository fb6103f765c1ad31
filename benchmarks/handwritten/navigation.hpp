// Navigation_MDP_ippc2011 10: one robot, of which the state is its place. An action has at most one
// direction (max-nondef-actions).
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct Navigation : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 40;
    static constexpr bool stochastic = true;
    static constexpr std::size_t cells = std::size(navigation::danger);
    static constexpr std::int64_t gone = cells;  // the place of a robot that is lost

    template <class L>
    struct State {
        typename L::Int place;
    };
    template <class L>
    struct Actions {
        typename L::Int direction;  // north, south, east, west, none
    };

    static void start(State<rddl::Scalar>& state) { state.place = navigation::robot; }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        state.place = select(where, std::int64_t{navigation::robot}, state.place);
    }

    // Bytes 0 or 1 as the number of the first that is 1, or 4.
    static std::int64_t first_true(const std::byte* record) {
        std::uint32_t bytes;
        std::memcpy(&bytes, record, sizeof bytes);
        return __builtin_ctzll(bytes | std::uint64_t{1} << 32) / 8;
    }
    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        actions.direction = first_true(record);
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        std::int64_t each[L::width];
        for (std::size_t lane = 0; lane < L::width; ++lane)
            each[lane] = first_true(records + 4 * lane);
        actions.direction = L::Int::load(each);
    }

    // For each place and direction the next place, and the threshold of the number by which the
    // robot is lost on its way; a robot that stays is not.
    static constexpr std::size_t directions = 5;
    struct Moves {
        std::int64_t to[(cells + 1) * directions];
        std::uint64_t safe[(cells + 1) * directions];
    };
    static constexpr Moves moves = [] {
        Moves all{};
        for (std::size_t place = 0; place <= cells; ++place)
            for (std::size_t direction = 0; direction < directions; ++direction) {
                const std::size_t at = place * directions + direction;
                const bool moves = direction < 4 && place < cells && place != navigation::goal;
                const int to = moves ? navigation::next[direction][place] : -1;
                all.to[at] = to < 0 ? static_cast<std::int64_t>(place) : to;
                all.safe[at] = to < 0 ? threshold(1) : threshold(1.0 - navigation::danger[to]);
            }
        return all;
    }();

    template <class Draws>
    static double step(State<rddl::Scalar>& state, const Actions<rddl::Scalar>& actions,
                       const Draws& draws) {
        const double reward = state.place == navigation::goal ? 0.0 : -1.0;
        const auto at = static_cast<std::size_t>(state.place) * directions +
                        static_cast<std::size_t>(actions.direction);
        state.place = moves.to[at];
        if (moves.safe[at] < threshold(1) &&
            integer_at(draws, 0, static_cast<std::size_t>(state.place)) >= moves.safe[at])
            state.place = gone;
        return reward;
    }

    template <int n, class Draws>
    static rddl::Lanes<double, n> step(State<rddl::Pack<n>>& state,
                                       const Actions<rddl::Pack<n>>& actions, const Draws& draws) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        using Real = rddl::Lanes<double, n>;
        const Real reward = select(state.place == navigation::goal, Real{0.0}, Real{-1.0});
        const auto at =
            state.place + rddl::ints_of(rddl::words_of(state.place) << 2) + actions.direction;
        const auto to = gather_integers(moves.to, at);
        const auto safe = gather_integers(moves.safe, at);
        const Word place = rddl::words_of(to);
        const auto numbers = draws.two_integers(Word{std::uint64_t{0}}, place >> 1);
        const auto number = if_zero(place & std::uint64_t{1}, numbers.even, numbers.odd);
        state.place = select(is_below(number, safe), to, rddl::Lanes<std::int64_t, n>{gone});
        return reward;
    }

    template <class L>
    static void store(const State<L>& state, std::int64_t lane, std::byte* record) {
        std::memset(record, 0, cells);
        const auto place = static_cast<std::size_t>(lane_of(state.place, lane));
        if (place < cells) record[place] = std::byte{1};
    }
};

}  // namespace handwritten
