// CartPole_Continuous_gym and CartPole_Discrete_gym.
#pragma once

#include "arithmetic.hpp"

namespace least_steps {

struct CartPole {
    template <class L>
    struct State {
        typename L::Real position, angle, velocity, angular_velocity;

        void each(auto& records) { records.reals(position, angle, velocity, angular_velocity); }
    };

    template <class L>
    static RDDL_INLINE void move(const State<L>& state, const typename L::Real& force,
                                 State<L>& next) {
        using Real = typename L::Real;
        const auto [sin, cos] = sin_cos(state.angle);
        const Real turn = 0.05 * (state.angular_velocity * state.angular_velocity);
        const Real push = over(force + turn * sin, 1.1);
        const Real inertia = 0.5 * (4.0 / 3.0 - over(0.1 * (cos * cos), 1.1));
        const Real angular_acceleration = (9.8 * sin - cos * push) / inertia;
        const Real acceleration = push - over(0.05 * angular_acceleration * cos, 1.1);
        next.position = state.position + 0.02 * state.velocity;
        next.angle = state.angle + 0.02 * state.angular_velocity;
        next.velocity = state.velocity + 0.02 * acceleration;
        next.angular_velocity = state.angular_velocity + 0.02 * angular_acceleration;
    }
};

struct ContinuousCartPole : CartPole {
    template <class L>
    struct Action {
        typename L::Real force;

        void each(auto& records) { records.reals(force); }
    };

    template <class L>
    static RDDL_INLINE typename L::Real step(const State<L>& state, const Action<L>& action,
                                             const auto&, State<L>& next) {
        move<L>(state, action.force, next);
        return 1;  // it is 0 only in states in which an episode is over
    }
};

struct DiscreteCartPole : CartPole {
    template <class L>
    struct Action {
        typename L::Real side;

        void each(auto& records) { records.ints(side); }
    };

    template <class L>
    static RDDL_INLINE typename L::Real step(const State<L>& state, const Action<L>& action,
                                             const auto&, State<L>& next) {
        using Real = typename L::Real;
        move<L>(state, rddl::select(action.side == Real{1}, Real{10}, Real{-10}), next);
        return 1;
    }
};

}  // namespace least_steps
