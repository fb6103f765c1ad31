// CartPole_Continuous_gym.
#pragma once

#include "reference.hpp"
#include "registers.hpp"

namespace handwritten {

struct CartPole {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 200;
    static constexpr bool stochastic = false;

    template <class L>
    struct State {
        typename L::Real position, angle, velocity, angular_velocity;
    };
    template <class L>
    struct Actions {
        typename L::Real force;
    };

    static void start(State<rddl::Scalar>& state) { state = {0, 0.1, 0, 0}; }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        state = {select(where, 0.0, state.position), select(where, 0.1, state.angle),
                 select(where, 0.0, state.velocity), select(where, 0.0, state.angular_velocity)};
    }

    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        std::memcpy(&actions.force, record, sizeof(double));
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        actions.force = L::Real::load(reinterpret_cast<const double*>(records));
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws&) {
        using Real = typename L::Real;
        constexpr double per_mass = 1 / 1.1, pole = 0.5 * 0.1;
        const Real reward = select(outside(s), 0.0, 1.0);
        const auto [sin, cos] = sin_cos(s.angle);
        const Real push =
            (actions.force + pole * (s.angular_velocity * s.angular_velocity) * sin) * per_mass;
        const Real angular_acceleration =
            (9.8 * sin - cos * push) / (0.5 * (4.0 / 3.0) - 0.5 * 0.1 * per_mass * (cos * cos));
        const Real acceleration = push - pole * per_mass * (angular_acceleration * cos);
        s = {s.position + 0.02 * s.velocity, s.angle + 0.02 * s.angular_velocity,
             s.velocity + 0.02 * acceleration, s.angular_velocity + 0.02 * angular_acceleration};
        return reward;
    }

    template <class State>
    static auto outside(const State& s) {
        return rddl::absolute(s.position) > 2.4 || rddl::absolute(s.angle) > 0.2094395;
    }
    // The terminations and the invariants say the same.
    template <class State>
    static auto terminated(const State& state) {
        return outside(state);
    }
    template <class State>
    static auto broken(const State& state) {
        return outside(state);
    }

    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        const double values[] = {lane_of(s.position, lane), lane_of(s.angle, lane),
                                 lane_of(s.velocity, lane), lane_of(s.angular_velocity, lane)};
        std::memcpy(record, values, sizeof values);
    }
};

}  // namespace handwritten
