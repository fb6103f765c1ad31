// UAV_Continuous 1 and UAV_ippc2023 3: three aircraft, some of which are steered; the others are
// moved by the wind.
#pragma once

#include "arithmetic.hpp"

namespace least_steps {

// The constants of an instance C: who is steered, the goals, the variance of the wind, the greatest
// acceleration.
template <class C>
struct Aircraft {
    static constexpr std::size_t count = 3;
    // The indices of draws.
    static constexpr std::size_t first_in_wind = C::steered[0] ? 1 : 0;
    static constexpr std::size_t end_in_wind = C::steered[1] ? 1 : count;

    template <class L>
    using Reals = std::array<typename L::Real, count>;

    template <class L>
    struct State {
        Reals<L> x, y, z, pitch, roll, yaw, speed;

        void each(auto& records) { records.reals(x, y, z, pitch, roll, yaw, speed); }
    };
    template <class L>
    struct Action {
        Reals<L> acceleration, roll, pitch;

        void each(auto& records) { records.reals(acceleration, roll, pitch); }
    };

    template <class Real>
    static RDDL_INLINE Real within(const Real& a, double limit) {
        return rddl::maximum(rddl::minimum(a, Real{limit}), Real{-limit});
    }

    template <class L>
    static RDDL_INLINE void steer(const State<L>& state, const Action<L>& action, std::size_t a,
                                  State<L>& next) {
        using Real = typename L::Real;
        // A slow aircraft turns so fast that its yaw may be too great an angle for sin_cos.
        const Real sin = rddl::sin(state.yaw[a]), cos = rddl::cos(state.yaw[a]);
        const Real way = 0.1 * state.speed[a];
        next.x[a] = state.x[a] + way * cos;
        next.y[a] = state.y[a] + way * sin;
        next.z[a] = state.z[a] + way * rddl::sin(state.pitch[a]);
        next.roll[a] = state.roll[a] + 0.1 * within(action.roll[a], 1);
        next.pitch[a] = state.pitch[a] + 0.1 * within(action.pitch[a], 1);
        const Real turn = rddl::tan(state.roll[a]) / (state.speed[a] + 0.001);
        next.yaw[a] = state.yaw[a] + 0.1 * turn * 9.8;
        const Real faster = 0.1 * within(action.acceleration[a], C::greatest_acceleration);
        next.speed[a] = rddl::maximum(Real{0}, state.speed[a] + faster);
    }

    // The aircraft draw together at each site.
    template <class L>
    static RDDL_INLINE void drift(const Reals<L>& values, const auto& draws, std::uint64_t site,
                                  Reals<L>& next) {
        using R = typename L::Element;
        const R deviation = std::sqrt(R(C::wind_variance));
        const auto normals =
            draws.template normals<end_in_wind - first_in_wind, first_in_wind>(site);
        for (std::size_t a = first_in_wind; a < end_in_wind; ++a)
            next[a] = values[a] + deviation * normals[a - first_in_wind];
    }

    template <class L>
    static RDDL_INLINE typename L::Real step(const State<L>& state, const Action<L>& action,
                                             const auto& draws, State<L>& next) {
        using Real = typename L::Real;
        for (std::size_t a = 0; a < count; ++a)
            if (C::steered[a]) steer<L>(state, action, a, next);
        drift<L>(state.roll, draws, 0, next.roll);
        drift<L>(state.x, draws, 1, next.x);
        drift<L>(state.y, draws, 2, next.y);
        drift<L>(state.z, draws, 3, next.z);
        drift<L>(state.yaw, draws, 4, next.yaw);
        drift<L>(state.pitch, draws, 5, next.pitch);
        drift<L>(state.speed, draws, 6, next.speed);
        for (std::size_t a = first_in_wind; a < end_in_wind; ++a)
            next.speed[a] = rddl::maximum(Real{0}, next.speed[a]);

        Real far = 0;
        for (std::size_t a = 0; a < count; ++a) {
            if (!C::steered[a]) continue;
            const Real x = state.x[a] - C::goal_x[a], y = state.y[a] - C::goal_y[a];
            const Real z = state.z[a] - C::goal_z[a];
            far = far + rddl::sqrt(x * x + y * y + z * z);
        }
        return -far;
    }
};

struct OneOfThree {
    static constexpr bool steered[] = {true, false, false};
    static constexpr double goal_x[] = {50, 100, 100}, goal_y[] = {50, 100, 100};
    static constexpr double goal_z[] = {50, 100, 100};
    static constexpr double wind_variance = 0.1, greatest_acceleration = 1;
};
struct TwoOfThree {
    static constexpr bool steered[] = {false, true, true};
    static constexpr double goal_x[] = {28.637974838246876, 49.4255392636407, 39.22984112638737};
    static constexpr double goal_y[] = {7.116868879325978, 9.31605658550707, 27.15131354655361};
    static constexpr double goal_z[] = {70.23322181340839, 34.536066418960885, 43.71756703098146};
    static constexpr double wind_variance = 4, greatest_acceleration = 10;
};
using OneSteeredAircraft = Aircraft<OneOfThree>;
using TwoSteeredAircraft = Aircraft<TwoOfThree>;

}  // namespace least_steps
