// Option_or 1: two assets.
#pragma once

#include "arithmetic.hpp"

namespace least_steps {

struct Option {
    static constexpr std::size_t assets = 2;

    template <class L>
    struct State {
        std::array<typename L::Real, assets> price;
        typename L::Real time;
        typename L::Bool exercised;

        void each(auto& records) {
            records.reals(price, time);
            records.bools(exercised);
        }
    };
    template <class L>
    struct Action {
        typename L::Bool exercise;

        void each(auto& records) { records.bools(exercise); }
    };

    template <class L>
    static RDDL_INLINE typename L::Real step(const State<L>& state, const Action<L>& action,
                                             const auto& draws, State<L>& next) {
        using Real = typename L::Real;
        next.exercised = state.exercised || action.exercise || state.time >= Real{0.24};
        next.time = state.time + 0.004;
        const auto wiener = draws.template normals<assets>(0);
        const Real first = factors[0] * wiener[0] + factors[1] * wiener[1];
        const Real second = factors[2] * wiener[1];
        next.price[0] = state.price[0] * rddl::exp(drift[0] + first * root_of_time);
        next.price[1] = state.price[1] * rddl::exp(drift[1] + second * root_of_time);
        const Real profit = rddl::maximum(state.price[0], state.price[1]) - 11;
        return rddl::select(next.exercised && !state.exercised, rddl::maximum(Real{0}, profit),
                            Real{0});
    }

    static constexpr double factors[] = {0.22360679774997896, 0.27386127875258304,
                                         0.4743416490252569};
    static constexpr double drift[] = {0.00030000000000000003, 6e-04};
    static constexpr double root_of_time = 0.06324555320336758;
};

}  // namespace least_steps
