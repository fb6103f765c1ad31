// Navigation_Continuous 0: two zones that slow down, in two dimensions.
#pragma once

#include "arithmetic.hpp"

namespace least_steps {

struct Navigation {
    template <class L>
    struct State {
        std::array<typename L::Real, 2> location;

        void each(auto& records) { records.reals(location); }
    };
    template <class L>
    struct Action {
        std::array<typename L::Real, 2> move;

        void each(auto& records) { records.reals(move); }
    };

    template <class Location>
    static RDDL_INLINE auto distance(const Location& location, double x, double y) {
        const auto across = x - location[0], along = y - location[1];
        return rddl::sqrt(across * across + along * along);
    }

    template <class L>
    static RDDL_INLINE typename L::Real step(const State<L>& state, const Action<L>& action,
                                             const auto& draws, State<L>& next) {
        using Real = typename L::Real;
        const auto speed_in = [&](double x, double y, double decay) {
            return 2.0 / (1.0 + rddl::exp(decay * distance(state.location, x, y))) - 1.0;
        };
        const Real speed = speed_in(5, 4.5, -1.15) * speed_in(1.5, 3, -1.2);
        const auto normals = draws.template normals<2>(0);
        for (std::size_t l = 0; l < 2; ++l) {
            const Real deviation = rddl::sqrt(0.05 * rddl::absolute(action.move[l]));
            next.location[l] = state.location[l] + speed * action.move[l] + deviation * normals[l];
        }
        return -distance(state.location, 8, 9);
    }
};

}  // namespace least_steps
