// Acrobot_gym.
#pragma once

#include "arithmetic.hpp"

namespace least_steps {

struct Acrobot {
    template <class L>
    struct State {
        typename L::Real angle1, angle2, velocity1, velocity2, acceleration1, acceleration2;

        void each(auto& records) {
            records.reals(angle1, angle2, velocity1, velocity2, acceleration1, acceleration2);
        }
    };
    template <class L>
    struct Action {
        typename L::Real torque;

        void each(auto& records) { records.ints(torque); }
    };

    template <class L>
    static RDDL_INLINE typename L::Real step(const State<L>& state, const Action<L>& action,
                                             const auto&, State<L>& next) {
        using Real = typename L::Real;
        constexpr double pi = 3.14159265;
        const auto limited = [](const Real& velocity, double limit) {
            return rddl::maximum(Real{-limit}, rddl::minimum(Real{limit}, velocity));
        };
        next.angle1 = state.angle1 + 0.05 * state.velocity1;
        next.angle2 = state.angle2 + 0.05 * state.velocity2;
        next.velocity1 = limited(state.velocity1 + 0.05 * state.acceleration1, 4 * pi);
        next.velocity2 = limited(state.velocity2 + 0.05 * state.acceleration2, 9 * pi);

        const auto [sin2, cos2] = sin_cos(state.angle2);
        const Real d1 = 0.25 + (1.25 + cos2) + 1.0 + 1.0;
        const Real d2 = 0.25 + 0.5 * cos2 + 1.0;
        const Real phi2 = 4.9 * rddl::cos(state.angle1 + state.angle2 - pi / 2);
        const Real phi1 = -0.5 * state.velocity2 * state.velocity2 * sin2 -
                          state.velocity2 * state.velocity1 * sin2 +
                          14.700000000000001 * rddl::cos(state.angle1 - pi / 2) + phi2;
        next.acceleration1 = -(d2 * state.acceleration2 + phi1) / d1;
        next.acceleration2 = (action.torque + d2 / d1 * phi1 - phi2) / (1.25 - d2 * d2 / d1);
        return -1;  // it is 0 only in states in which an episode is over
    }
};

}  // namespace least_steps
