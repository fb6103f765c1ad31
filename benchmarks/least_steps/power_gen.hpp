// PowerGen_ippc2023 3: five plants.
#pragma once

#include "arithmetic.hpp"

namespace least_steps {

struct PowerGen {
    static constexpr std::size_t plants = 5;
    static constexpr double least[] = {1, 1, 2, 2, 1};
    static constexpr double greatest[] = {6, 6, 20, 20, 4};
    static constexpr double change_cost[] = {1, 1, 2, 2, 0.5};
    static constexpr double start_cost[] = {6, 6, 60, 60, 4};
    static constexpr double unit_cost[] = {4, 4, 1, 1, 3};
    static constexpr double scale[] = {1e-07, 1e-07, 0.001, 0.001, 1};

    template <class L>
    struct State {
        std::array<typename L::Real, plants> produced;
        std::array<typename L::Bool, plants> on;
        typename L::Real temperature;

        void each(auto& records) {
            records.reals(produced);
            records.bools(on);
            records.reals(temperature);
        }
    };
    template <class L>
    struct Action {
        std::array<typename L::Real, plants> production;

        void each(auto& records) { records.reals(production); }
    };

    template <class L>
    static RDDL_INLINE typename L::Real step(const State<L>& state, const Action<L>& action,
                                             const auto& draws, State<L>& next) {
        using Real = typename L::Real;
        using R = typename L::Element;
        const Real deviation = state.temperature - 11.7;
        const Real demand = 6.0 + 0.03 * (deviation * deviation);
        const Real change = Real{std::sqrt(R(7))} * draws.template normals<1>(0)[0];
        next.temperature =
            rddl::maximum(rddl::minimum(state.temperature + change, Real{40}), Real{-30});

        const auto more = draws.template exponentials<plants>(1);
        Real produced = 0, costs = 0, changes = 0, starts = 0;
        for (std::size_t p = 0; p < plants; ++p) {
            next.on[p] = action.production[p] >= Real{least[p]};
            const Real wanted =
                rddl::minimum(action.production[p] + scale[p] * more[p], Real{greatest[p]});
            const Real amount =
                rddl::select(next.on[p], rddl::maximum(wanted, Real{least[p]}), Real{0});
            next.produced[p] = amount;
            produced = p == 0 ? amount : produced + amount;
            costs = costs + amount * unit_cost[p];
            changes = changes + rddl::absolute(amount - state.produced[p]) * change_cost[p];
            starts =
                starts + rddl::select(!state.on[p] && next.on[p], Real{start_cost[p]}, Real{0});
        }
        const Real fulfilled = rddl::minimum(demand, produced);
        const Real penalty = rddl::select(demand > fulfilled, Real{1000}, Real{0});
        return -costs + fulfilled * 8.0 - penalty + changes - starts;
    }
};

}  // namespace least_steps
