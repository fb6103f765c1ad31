// Reacher_physics 1: three segments, the last of which has the target.
#pragma once

#include "arithmetic.hpp"

namespace least_steps {

struct Reacher {
    static constexpr std::size_t segments = 3;
    template <class L>
    using Reals = std::array<typename L::Real, segments>;

    template <class L>
    struct State {
        Reals<L> angle, velocity, tip_x, tip_y;

        void each(auto& records) { records.reals(angle, velocity, tip_x, tip_y); }
    };
    template <class L>
    struct Action {
        Reals<L> torque;

        void each(auto& records) { records.reals(torque); }
    };

    template <class L>
    static RDDL_INLINE typename L::Real step(const State<L>& state, const Action<L>& action,
                                             const auto&, State<L>& next) {
        using Real = typename L::Real;
        constexpr double length[segments] = {0.6, 0.4, 0.3};
        for (std::size_t s = 0; s < segments; ++s) {
            next.angle[s] = state.angle[s] + state.velocity[s];
            next.velocity[s] = state.velocity[s] + action.torque[s];
            const auto [sin, cos] = sin_cos(state.angle[s]);
            const Real x = length[s] * cos, y = length[s] * sin;
            next.tip_x[s] = s == 0 ? x : next.tip_x[s - 1] + x;
            next.tip_y[s] = s == 0 ? y : next.tip_y[s - 1] + y;
        }
        const Real x = next.tip_x[segments - 1] - 0.7, y = next.tip_y[segments - 1] - 0.7;
        return -(x * x + y * y);
    }
};

}  // namespace least_steps
