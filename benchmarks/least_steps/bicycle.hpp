// Bicycle_physics 0.
#pragma once

#include "arithmetic.hpp"

namespace least_steps {

struct Bicycle {
    template <class L>
    struct State {
        typename L::Real lean, lean_speed, bar, bar_speed, heading;

        void each(auto& records) { records.reals(lean, lean_speed, bar, bar_speed, heading); }
    };
    template <class L>
    struct Action {
        typename L::Real torque, displacement;

        void each(auto& records) { records.reals(torque, displacement); }
    };

    template <class L>
    static RDDL_INLINE typename L::Real step(const State<L>& state, const Action<L>& action,
                                             const auto& draws, State<L>& next) {
        using Real = typename L::Real;
        using R = typename L::Element;
        constexpr R pi = 3.14159265, steepest = 1.3962634;
        const Real side = rddl::select(state.bar > Real{0}, Real{1},
                                       rddl::select(state.bar < Real{0}, Real{-1}, Real{0}));
        next.lean = state.lean + 0.01 * state.lean_speed;

        const Real turned = state.bar + 0.01 * state.bar_speed;
        const auto turns = rddl::absolute(turned) <= Real{steepest};
        const Real torque = action.torque - 2.408332659 * state.lean_speed;
        next.bar_speed = rddl::select(
            turns, state.bar_speed + over(0.01 * torque, 0.09826000000000001), Real{0});
        const Real end = rddl::select(turned > Real{0}, Real{1}, Real{-1});
        next.bar = rddl::select(turns, turned, end * (R(80) / R(180) * pi));

        const Real back = over(rddl::absolute(rddl::tan(state.bar)), 1.11);
        const Real front = over(rddl::absolute(rddl::sin(state.bar)), 1.11);
        const Real centre =
            rddl::select(side == Real{0}, Real{0},
                         Real{1} / rddl::sqrt(0.20250000000000007 + per_square(back + 1e-10)));

        constexpr R width = R(0.02) - R(-0.02);
        const Real noise = R(-0.02) + width * draws.uniform(0);
        const Real angle = state.lean + over(rddl::atan(action.displacement + noise), 0.94);
        const auto [sin, cos] = sin_cos(angle);
        const Real turn = 0.5780000000000001 * (front + back) + 70.5 * centre;
        const Real pull = 1.6055551060000002 * state.bar_speed + turn_of(side, turn);
        next.lean_speed =
            state.lean_speed + over(0.01 * (692.3100000000001 * sin - cos * pull), 149.69);

        const Real heading = modulo(state.heading + 0.01 * side * 2.777777 * back, 2 * 3.14159265);
        next.heading = rddl::select(heading > Real{pi}, heading - R(2 * 3.14159265), heading);
        return rddl::select(rddl::absolute(state.lean) < Real{0.20943951000000002}, Real{1},
                            Real{0});
    }

    template <class Real>
    static RDDL_INLINE Real turn_of(const Real& side, const Real& turn) {
        return side * 7.716045061729 * turn;
    }

    template <class Real>
    static RDDL_INLINE Real per_square(const Real& a) {
        return rddl::power(a, Real{-2});
    }
};

}  // namespace least_steps
