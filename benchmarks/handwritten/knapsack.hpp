// Knapsack_or 0: one knapsack, items of three kinds.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct Knapsack : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 40;
    static constexpr bool stochastic = true;
    static constexpr std::int64_t capacity = 20, first_weight = 3, first_value = 4;

    template <class L>
    struct State {
        typename L::Int total_weight, total_value, weight, value;
    };
    template <class L>
    struct Actions {
        typename L::Bool place;
    };

    static void start(State<rddl::Scalar>& state) { state = {0, 0, first_weight, first_value}; }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        const std::int64_t none = 0;
        state = {select(where, none, state.total_weight), select(where, none, state.total_value),
                 select(where, first_weight, state.weight),
                 select(where, first_value, state.value)};
    }

    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        actions.place = *record != std::byte{0};
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        actions.place = L::Bool::of_bits(bits_of_bytes<L::width>(records));
    }

    static constexpr std::uint64_t before_second = threshold(knapsack::probability[0]),
                                   before_third = threshold(knapsack::probability[0] +
                                                            knapsack::probability[1]);

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        using Int = typename L::Int;
        const auto reward = rddl::to_real(s.total_value);
        const Int weight = s.total_weight + s.weight;
        const auto fits = actions.place && weight <= capacity;
        const Word number = draws.two_integers(Word{std::uint64_t{0}}, Word{std::uint64_t{0}}).even;
        const auto is_first = is_below(number, Word{before_second});
        const auto is_second = is_below(number, Word{before_third});
        const auto choose = [&](const std::int64_t(&of)[3]) {
            return select(is_first, Int{of[0]}, select(is_second, Int{of[1]}, Int{of[2]}));
        };
        s = {select(fits, weight, s.total_weight),
             select(fits, s.total_value + s.value, s.total_value), choose(knapsack::weight),
             choose(knapsack::value)};
        return reward;
    }

    // A step puts nothing into a knapsack that is full, and draws only items that there are.
    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        const std::int64_t values[] = {lane_of(s.total_weight, lane), lane_of(s.total_value, lane),
                                       lane_of(s.weight, lane), lane_of(s.value, lane)};
        std::memcpy(record, values, sizeof values);
    }
};

}  // namespace handwritten
