// MountainCar_Continuous_gym and MountainCar_Discrete_gym.
#pragma once

#include "arithmetic.hpp"

namespace least_steps {

struct MountainCar {
    template <class L>
    struct State {
        typename L::Real position, velocity;

        void each(auto& records) { records.reals(position, velocity); }
    };

    template <class L>
    static RDDL_INLINE void move(const State<L>& state, const typename L::Real& acceleration,
                                 State<L>& next) {
        using Real = typename L::Real;
        const Real slope = rddl::cos(3.0 * state.position) * -0.0025;
        const Real velocity = state.velocity + acceleration + slope * 1.35;
        next.velocity = rddl::maximum(rddl::minimum(velocity, Real{0.07}), Real{-0.07});
        next.position =
            rddl::maximum(rddl::minimum(state.position + next.velocity, Real{0.6}), Real{-1.2});
    }
    template <class L>
    static RDDL_INLINE typename L::Real at_goal(const State<L>& next, double goal, double reward) {
        using Real = typename L::Real;
        return rddl::select(next.position >= Real{goal} && next.velocity >= Real{0}, Real{reward},
                            Real{0});
    }
};

struct ContinuousMountainCar : MountainCar {
    template <class L>
    struct Action {
        typename L::Real force;

        void each(auto& records) { records.reals(force); }
    };

    template <class L>
    static RDDL_INLINE typename L::Real step(const State<L>& state, const Action<L>& action,
                                             const auto&, State<L>& next) {
        move<L>(state, action.force * 0.0015, next);
        return at_goal<L>(next, 0.45, 100) - 0.1 * (action.force * action.force);
    }
};

struct DiscreteMountainCar : MountainCar {
    template <class L>
    struct Action {
        typename L::Real direction;

        void each(auto& records) { records.ints(direction); }
    };

    template <class L>
    static RDDL_INLINE typename L::Real step(const State<L>& state, const Action<L>& action,
                                             const auto&, State<L>& next) {
        move<L>(state, (action.direction - 1) * 0.001, next);
        return at_goal<L>(next, 0.5, 1);
    }
};

}  // namespace least_steps
