// MountainCar_ippc2023 1: a slope of 99 segments of the same width.
#pragma once

#include "reference.hpp"
#include "registers.hpp"
#include "tables.hpp"

#include <array>
#include <limits>

namespace handwritten {

struct MountainCar : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 200;
    static constexpr bool stochastic = false;

    template <class L>
    struct State {
        typename L::Real position, velocity;
    };
    template <class L>
    struct Actions {
        typename L::Real force;
    };

    static void start(State<rddl::Scalar>& state) { state = {-0.6, 0.01}; }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        state = {select(where, -0.6, state.position), select(where, 0.01, state.velocity)};
    }

    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        std::memcpy(&actions.force, record, sizeof(double));
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        actions.force = L::Real::load(reinterpret_cast<const double*>(records));
    }

    // Begin and slope of each segment; the part after the last one has no slope and no end.
    static constexpr std::size_t segments = std::size(mountain_car::slopes);
    static constexpr auto starts = [] {
        std::array<double, segments + 2> all{};
        for (std::size_t i = 0; i < segments; ++i) all[i] = mountain_car::starts[i];
        all[segments] = mountain_car::end;
        all[segments + 1] = std::numeric_limits<double>::infinity();
        return all;
    }();
    static constexpr auto slopes = [] {
        std::array<double, segments + 1> all{};
        for (std::size_t i = 0; i < segments; ++i) all[i] = mountain_car::slopes[i];
        return all;
    }();
    static constexpr double per_unit = segments / (mountain_car::end - mountain_car::starts[0]);

    // The guess is off by one at most.
    static double slope_at(double x) {
        auto segment = static_cast<std::int64_t>((x - starts[0]) * per_unit);
        segment += x >= starts[segment + 1];
        segment -= x < starts[segment];
        return slopes[segment];
    }
    template <int n>
    static rddl::Lanes<double, n> slope_at(const rddl::Lanes<double, n>& x) {
        using Int = rddl::Lanes<std::int64_t, n>;
        Int segment = rddl::truncate_to_int((x - starts[0]) * per_unit);
        segment += select(x >= gather(starts.data(), segment + Int{1}), 1, 0);
        segment += select(x < gather(starts.data(), segment), -1, 0);
        return gather(slopes.data(), segment);
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& state, const Actions<L>& actions, const Draws&) {
        using Real = typename L::Real;
        const Real position =
            larger(smaller(state.position + state.velocity, 0.6000000000000001), -1.2);
        const Real push = actions.force * 0.0015 - 0.0025 * slope_at(state.position);
        const Real velocity = larger(smaller(state.velocity + push, 0.07), -0.07);
        state = {position, velocity};
        return select(at_goal(state), 100.0, 0.0);
    }

    template <class State>
    static auto at_goal(const State& state) {
        return state.position >= 0.5 && state.velocity >= 0.0;
    }
    template <class State>
    static auto terminated(const State& state) {
        return at_goal(state);
    }
    // The step keeps position and velocity within their bounds.
    template <class L>
    static void store(const State<L>& state, std::int64_t lane, std::byte* record) {
        const double values[] = {lane_of(state.position, lane), lane_of(state.velocity, lane)};
        std::memcpy(record, values, sizeof values);
    }
};

}  // namespace handwritten
