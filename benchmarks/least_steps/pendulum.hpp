// Pendulum_gym.
#pragma once

#include "arithmetic.hpp"

namespace least_steps {

struct Pendulum {
    template <class L>
    struct State {
        typename L::Real angle, velocity, x, y;

        void each(auto& records) { records.reals(angle, velocity, x, y); }
    };
    template <class L>
    struct Action {
        typename L::Real torque;

        void each(auto& records) { records.reals(torque); }
    };

    template <class L>
    static RDDL_INLINE typename L::Real step(const State<L>& state, const Action<L>& action,
                                             const auto&, State<L>& next) {
        using Real = typename L::Real;
        constexpr double pi = 3.14159265;
        const Real force = 14.700000000000001 * rddl::sin(state.angle) + 3.0 * action.torque;
        next.velocity =
            rddl::maximum(rddl::minimum(state.velocity + force * 0.05, Real{8}), Real{-8});
        next.angle = state.angle + next.velocity * 0.05;
        const auto [sin, cos] = sin_cos(next.angle);
        next.x = cos;
        next.y = sin;
        const Real deviation = modulo(state.angle + pi, 2 * pi) - pi;
        return -(deviation * deviation + 0.1 * (state.velocity * state.velocity) +
                 0.001 * (action.torque * action.torque));
    }
};

}  // namespace least_steps
