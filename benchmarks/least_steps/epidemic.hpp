// Epidemic 0: three groups.
#pragma once

#include "arithmetic.hpp"

namespace least_steps {

struct Epidemic {
    static constexpr std::size_t groups = 3;
    static constexpr double contacts[groups][groups] = {
        {0.5, 0.25, 0.1}, {0.1, 0.3, 0.15}, {0.05, 0.1, 0.2}};
    static constexpr double hospital_rate[] = {0.01, 0.1, 0.25};
    static constexpr double death_rate[] = {0.01, 0.03, 0.1};

    template <class L>
    using Reals = std::array<typename L::Real, groups>;

    template <class L>
    struct State {
        Reals<L> susceptible, exposed, infected, recovered, hospital, dead;

        void each(auto& records) {
            records.reals(susceptible, exposed, infected, recovered, hospital, dead);
        }
    };
    template <class L>
    struct Action {
        Reals<L> vaccinated;
        typename L::Real distance;
        typename L::Bool schools_are_closed;

        void each(auto& records) {
            records.reals(vaccinated, distance);
            records.bools(schools_are_closed);
        }
    };

    template <class L>
    static RDDL_INLINE typename L::Real step(const State<L>& s, const Action<L>& action,
                                             const auto&, State<L>& next) {
        using Real = typename L::Real;
        const auto at_least_0 = [](const Real& a) {
            return rddl::maximum(Real{0}, a);
        };
        const auto at_most_1 = [](const Real& a) {
            return rddl::minimum(Real{1}, a);
        };
        const Real near = 1.0 - 0.7 * action.distance;
        const Real at_school = rddl::select(action.schools_are_closed, Real{0.2}, Real{1});
        Real dead = 0, vaccinated = 0, hospital = 0;
        for (std::size_t g = 0; g < groups; ++g) {
            Real rate = 0;
            for (std::size_t h = 0; h < groups; ++h) {
                const Real met = contacts[g][h] * near;
                rate = rate + (g == 0 || h == 0 ? met * at_school : met) * s.infected[h];
            }
            next.susceptible[g] =
                at_least_0((1.0 - rate) * s.susceptible[g] - action.vaccinated[g]);
            next.exposed[g] = at_least_0(at_most_1(0.8 * s.exposed[g] + rate * s.susceptible[g]));
            next.infected[g] = at_least_0(at_most_1(0.9 * s.infected[g] + 0.2 * s.exposed[g]));
            next.recovered[g] =
                at_least_0(at_most_1(s.recovered[g] + 0.1 * s.infected[g] + action.vaccinated[g]));
            next.hospital[g] =
                at_least_0(at_most_1(0.5 * s.hospital[g] + hospital_rate[g] * s.infected[g]));
            next.dead[g] = at_most_1(s.dead[g] + death_rate[g] * s.hospital[g]);
            dead = dead + s.dead[g];
            vaccinated = vaccinated + action.vaccinated[g];
            hospital = hospital + s.hospital[g];
        }
        const Real closed = rddl::select(action.schools_are_closed, Real{1}, Real{0});
        return -1000.0 * dead - 0.05 * vaccinated - 0.5 * action.distance - closed -
               500.0 * at_least_0(hospital - 0.05);
    }
};

}  // namespace least_steps
