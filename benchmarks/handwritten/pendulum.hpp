// Pendulum_gym.
#pragma once

#include "reference.hpp"
#include "registers.hpp"

#include <cmath>

namespace handwritten {

struct Pendulum : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 200;
    static constexpr bool stochastic = false;
    static constexpr double pi = 3.14159265;  // as the domain has it

    template <class L>
    struct State {
        typename L::Real angle, velocity, x, y;
    };
    template <class L>
    struct Actions {
        typename L::Real torque;
    };

    static void start(State<rddl::Scalar>& state) { state = {pi, 0, 0, 0}; }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        state = {select(where, pi, state.angle), select(where, 0.0, state.velocity),
                 select(where, 0.0, state.x), select(where, 0.0, state.y)};
    }

    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        std::memcpy(&actions.torque, record, sizeof(double));
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        actions.torque = L::Real::load(reinterpret_cast<const double*>(records));
    }

    static double whole(double a) { return std::floor(a); }
    template <int n>
    static rddl::Lanes<double, n> whole(const rddl::Lanes<double, n>& a) {
        return rddl::Lanes<double, n>::each([](auto x) { return rddl::simd::floor(x); }, a);
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws&) {
        using Real = typename L::Real;
        const Real from_top = s.angle - whole((s.angle + pi) * (0.5 / pi)) * (2 * pi);
        const Real cost = from_top * from_top + 0.1 * (s.velocity * s.velocity) +
                          0.001 * (actions.torque * actions.torque);
        const Real push = 0.735 * rddl::sin(s.angle) + 0.15 * actions.torque;
        const Real velocity = larger(smaller(s.velocity + push, 8.0), -8.0);
        const Real angle = s.angle + velocity * 0.05;
        const auto [sin, cos] = sin_cos(angle);
        s = {angle, velocity, cos, sin};
        return -cost;
    }

    // The step keeps the velocity within its bounds.
    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        const double values[] = {lane_of(s.angle, lane), lane_of(s.velocity, lane),
                                 lane_of(s.x, lane), lane_of(s.y, lane)};
        std::memcpy(record, values, sizeof values);
    }
};

}  // namespace handwritten
