// Reservoir_Continuous 1, Reservoir_Discrete 1 and Reservoir_ippc2023 3: ten reservoirs.
#pragma once

#include "arithmetic.hpp"

namespace least_steps {

// The constants of an instance C: top, least and greatest levels, to how many reservoirs each
// flows, the variance of rain, and whether `from` flows to `to`.
template <class C>
struct Reservoirs {
    static constexpr std::size_t count = 10;
    template <class L>
    using Reals = std::array<typename L::Real, count>;

    template <class L>
    struct State {
        Reals<L> level;

        void each(auto& records) { records.reals(level); }
    };

    template <class L>
    static RDDL_INLINE typename L::Real flow(const State<L>& state, const Reals<L>& released,
                                             const auto& draws, State<L>& next) {
        using Real = typename L::Real;
        using R = typename L::Element;
        const auto normals = draws.template normals<count>(0);
        const Real deviation = std::sqrt(R(C::rain_variance));
        Reals<L> outflow;
        for (std::size_t r = 0; r < count; ++r) outflow[r] = over(released[r], C::receivers[r]);
        Real reward = 0;
        for (std::size_t r = 0; r < count; ++r) {
            const Real level = state.level[r];
            const Real overflow = rddl::maximum(Real{0}, level - released[r] - C::top[r]);
            Real inflow = 0;
            for (std::size_t from = 0; from < count; ++from)
                if (C::connected[from][r]) inflow = inflow + outflow[from];
            const Real rain = rddl::absolute(deviation * normals[r]);
            const Real evaporated = over(0.05 * level, C::top[r]);
            const Real changed = level + inflow + rain - evaporated - overflow - released[r];
            const Real reached = rddl::minimum(Real{C::top[r]}, rddl::maximum(Real{0}, changed));
            next.level[r] = reached;
            // No level is above the top.
            const Real too_low = -5.0 * (C::least[r] - reached);
            const Real too_high = -10.0 * (reached - C::greatest[r]);
            reward = reward +
                     rddl::select(reached < Real{C::least[r]}, too_low,
                                  rddl::select(reached > Real{C::greatest[r]}, too_high, Real{0}));
        }
        return reward;
    }
};

template <class C>
struct ContinuousReservoirs : Reservoirs<C> {
    using Base = Reservoirs<C>;
    template <class L>
    struct Action {
        typename Base::template Reals<L> release;

        void each(auto& records) { records.reals(release); }
    };

    template <class L>
    static RDDL_INLINE typename L::Real step(const typename Base::template State<L>& state,
                                             const Action<L>& action, const auto& draws,
                                             typename Base::template State<L>& next) {
        typename Base::template Reals<L> released;
        for (std::size_t r = 0; r < Base::count; ++r)
            released[r] = rddl::maximum(typename L::Real{0},
                                        rddl::minimum(state.level[r], action.release[r]));
        return Base::template flow<L>(state, released, draws, next);
    }
};

template <class C>
struct DiscreteReservoirs : Reservoirs<C> {
    using Base = Reservoirs<C>;
    template <class L>
    struct Action {
        std::array<typename L::Bool, Base::count> release;

        void each(auto& records) { records.bools(release); }
    };

    template <class L>
    static RDDL_INLINE typename L::Real step(const typename Base::template State<L>& state,
                                             const Action<L>& action, const auto& draws,
                                             typename Base::template State<L>& next) {
        using Real = typename L::Real;
        typename Base::template Reals<L> released;
        for (std::size_t r = 0; r < Base::count; ++r) {
            const Real share = over(-state.level[r], 0.05) * -0.048770575499285984;
            released[r] = rddl::select(action.release[r], share, Real{0});
        }
        return Base::template flow<L>(state, released, draws, next);
    }
};

struct SmallReservoirs {
    static constexpr double top[] = {100, 100, 100, 100, 100, 100, 100, 100, 100, 100};
    static constexpr double least[] = {20, 20, 20, 20, 20, 20, 20, 20, 20, 20};
    static constexpr double greatest[] = {80, 80, 80, 80, 80, 80, 80, 80, 80, 80};
    static constexpr double receivers[] = {1, 2, 2, 1, 1, 2, 1, 1, 1, 1};
    static constexpr double rain_variance = 5;
    static constexpr bool connected[10][10] = {
        {0, 0, 0, 0, 1, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 1, 1, 0, 0, 0, 0},
        {0, 0, 0, 0, 0, 1, 1, 0, 0, 0}, {0, 0, 0, 0, 0, 0, 1, 0, 0, 0},
        {0, 0, 0, 0, 0, 0, 0, 1, 0, 0}, {0, 0, 0, 0, 0, 0, 0, 1, 1, 0},
        {0, 0, 0, 0, 0, 0, 0, 0, 1, 0}, {0, 0, 0, 0, 0, 0, 0, 0, 0, 1},
        {0, 0, 0, 0, 0, 0, 0, 0, 0, 1}, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    };
};
using SmallContinuousReservoirs = ContinuousReservoirs<SmallReservoirs>;
using SmallDiscreteReservoirs = DiscreteReservoirs<SmallReservoirs>;

struct ThirdReservoirs {
    static constexpr double top[] = {365.1318947784891,  354.56815947704115, 159.98564094350357,
                                     206.54329864865548, 328.8257122826851,  312.3631504108888,
                                     128.04968259773747, 228.52315631505726, 316.604658365775,
                                     124.32384546502664};
    static constexpr double least[] = {99.28077123793895,  52.70500492913583,  15.816777351060948,
                                       73.60735148065014,  49.43402235793882,  112.64249162782089,
                                       19.655300953891356, 109.27118610302212, 55.454238538970834,
                                       81.34358088129179};
    static constexpr double greatest[] = {242.39769006937888, 146.82518673502517, 65.0007902681157,
                                          171.13792332611985, 163.53549045033566, 266.6245150000089,
                                          45.29329435401057,  182.40872437041935, 212.3383176934107,
                                          113.89335852327719};
    static constexpr double receivers[] = {3, 4, 1, 1, 3, 3, 2, 1, 5, 1};
    static constexpr double rain_variance = 20;
    static constexpr bool connected[10][10] = {
        {0, 1, 0, 1, 0, 0, 1, 0, 0, 0}, {0, 0, 0, 1, 1, 0, 1, 0, 0, 1},
        {0, 0, 0, 0, 0, 0, 0, 0, 0, 1}, {0, 0, 0, 0, 0, 0, 1, 0, 0, 0},
        {0, 0, 1, 0, 0, 0, 1, 0, 0, 1}, {0, 0, 0, 0, 1, 0, 1, 0, 0, 1},
        {0, 0, 1, 0, 0, 0, 0, 0, 0, 1}, {0, 0, 1, 0, 0, 0, 0, 0, 0, 0},
        {0, 0, 0, 1, 1, 0, 1, 1, 0, 1}, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    };
};
using IppcReservoirs = ContinuousReservoirs<ThirdReservoirs>;

}  // namespace least_steps
