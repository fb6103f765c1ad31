// Zombies_arcade 2: five persons.
#pragma once

#include "arithmetic.hpp"

namespace least_steps {

struct Zombies {
    static constexpr std::size_t count = 5;
    template <class L>
    using Reals = std::array<typename L::Real, count>;
    template <class L>
    using Bools = std::array<typename L::Bool, count>;

    template <class L>
    struct State {
        Reals<L> x, y;
        Bools<L> stunned;
        Reals<L> way;
        Bools<L> zombie;
        Reals<L> x_speed, y_speed;

        void each(auto& records) {
            records.reals(x, y);
            records.bools(stunned);
            records.reals(way);
            records.bools(zombie);
            records.reals(x_speed, y_speed);
        }
    };
    template <class L>
    struct Action {
        Reals<L> x, y;
        Bools<L> stun;

        void each(auto& records) {
            records.reals(x, y);
            records.bools(stun);
        }
    };

    // Where a person is next in one of the dimensions.
    template <class Real, class Bool>
    static RDDL_INLINE Real moved(const Real& place, const Real& speed, const Real& move,
                                  Bool zombie, Bool stunned, double length) {
        const Real next = place + rddl::select(zombie, speed, move);
        return rddl::select(zombie && stunned, place,
                            rddl::maximum(Real{0}, rddl::minimum(Real{length}, next)));
    }

    // A person whom a zombie is near becomes one, if the number of all that are near is drawn so.
    template <class L>
    static RDDL_INLINE typename L::Bool bitten(const State<L>& s, std::size_t a,
                                               const typename L::Real& number) {
        using Real = typename L::Real;
        typename L::Bool attacked(false);
        Real one_and_near = 1;
        for (std::size_t b = 0; b < count; ++b) {
            if (b == a) continue;
            const auto near = s.zombie[b] && rddl::absolute(s.x[b] - s.x[a]) < Real{1} &&
                              rddl::absolute(s.y[b] - s.y[a]) < Real{1};
            attacked = attacked || (near && !s.stunned[b]);
            one_and_near = one_and_near + rddl::select(near, Real{1}, Real{0});
        }
        return attacked && !(number < Real{1} / one_and_near);
    }

    template <class L>
    static RDDL_INLINE typename L::Real step(const State<L>& s, const Action<L>& action,
                                             const auto& draws, State<L>& next) {
        using Real = typename L::Real;
        next.x_speed = draws.template normals<count>(0);
        next.y_speed = draws.template normals<count>(1);
        const auto numbers = draws.template uniforms<count>(2);
        Real ways = 0, zombies = 0;
        for (std::size_t a = 0; a < count; ++a) {
            const Real x = action.x[a], y = action.y[a];
            next.way[a] = rddl::select(s.zombie[a], Real{0}, x * x + y * y);
            next.stunned[a] = action.stun[a];
            next.x[a] = moved(s.x[a], s.x_speed[a], x, s.zombie[a], s.stunned[a], 10);
            next.y[a] = moved(s.y[a], s.y_speed[a], y, s.zombie[a], s.stunned[a], 1);
            next.zombie[a] = s.zombie[a] || bitten<L>(s, a, numbers[a]);
            ways = ways - s.way[a];
            zombies = zombies + rddl::select(s.zombie[a], Real{-100}, Real{0});
        }
        return with_stuns<L>(s, action, ways) + zombies;
    }

    // The sum is rounded, so its order is that of the domain: zombies first.
    template <class L>
    static RDDL_INLINE typename L::Real with_stuns(const State<L>& s, const Action<L>& action,
                                                   const typename L::Real& ways) {
        using Real = typename L::Real;
        Real of_zombies = 0, of_others = 0;
        for (std::size_t a = 0; a < count; ++a) {
            of_zombies =
                of_zombies + rddl::select(s.zombie[a] && action.stun[a], Real{-20}, Real{0});
            of_others =
                of_others + rddl::select(!s.zombie[a] && action.stun[a], Real{-50}, Real{0});
        }
        return ways + of_zombies + of_others;
    }
};

}  // namespace least_steps
