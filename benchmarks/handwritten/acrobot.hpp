// Acrobot_gym 0.
#pragma once

#include "reference.hpp"
#include "registers.hpp"

#include <array>

namespace handwritten {

struct Acrobot : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 200;
    static constexpr bool stochastic = false;
    static constexpr double pi = 3.14159265, dt = 0.05;  // as the domain has them

    template <class L>
    struct State {
        typename L::Real angle, bend, speed, bend_speed, push, bend_push;
        typename L::Bool is_up;
    };
    template <class L>
    struct Actions {
        typename L::Real torque;
    };

    static void start(State<rddl::Scalar>& state) { state = {}; }
    template <class L>
    static void start(State<L>& s, typename L::Bool where) {
        for (auto* const value :
             {&s.angle, &s.bend, &s.speed, &s.bend_speed, &s.push, &s.bend_push})
            *value = select(where, 0.0, *value);
        s.is_up = s.is_up && !where;
    }

    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        std::int64_t torque;
        std::memcpy(&torque, record, sizeof torque);
        actions.torque = static_cast<double>(torque);
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        actions.torque =
            rddl::to_real(L::Int::load(reinterpret_cast<const std::int64_t*>(records)));
    }

    template <class Real>
    struct Angles {
        SinCos<Real> bend;
        Real shoulder, hand;            // cosines, a quarter turn back
        Real next_shoulder, next_both;  // cosines of the next state
    };
    // All angles of one environment are in one register.
    static Angles<double> angles(const State<rddl::Scalar>& s, const State<rddl::Scalar>& next) {
        const double all[lanes_in_one] = {s.bend, s.angle - pi / 2, s.angle + s.bend - pi / 2,
                                          next.angle, next.bend + next.angle};
        const auto [sin, cos] = sin_cos(rddl::Lanes<double, lanes_in_one>::load(all));
        return {{sin[0], cos[0]}, cos[1], cos[2], cos[3], cos[4]};
    }
    template <class L>
    static Angles<typename L::Real> angles(const State<L>& s, const State<L>& next) {
        return {sin_cos(s.bend), rddl::cos(s.angle - pi / 2), rddl::cos(s.angle + s.bend - pi / 2),
                rddl::cos(next.angle), rddl::cos(next.bend + next.angle)};
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws&) {
        using Real = typename L::Real;
        State<L> next;
        next.angle = s.angle + dt * s.speed;
        next.bend = s.bend + dt * s.bend_speed;
        next.speed = larger(smaller(s.speed + dt * s.push, 4 * pi), -4 * pi);
        next.bend_speed = larger(smaller(s.bend_speed + dt * s.bend_push, 9 * pi), -9 * pi);
        const auto at = angles(s, next);

        const Real inertia = 3.5 + at.bend.cos, bend_inertia = 1.25 + 0.5 * at.bend.cos;
        const Real weight = 4.9 * at.hand;
        const Real swing = -(s.bend_speed * (0.5 * s.bend_speed + s.speed)) * at.bend.sin +
                           1.5 * 9.8 * at.shoulder + weight;
        const Real ratio = bend_inertia / inertia;
        next.bend_push = (actions.torque + ratio * swing - weight) / (1.25 - bend_inertia * ratio);
        next.push = -(bend_inertia * s.bend_push + swing) / inertia;

        const Real reward = select(s.is_up, Real{0.0}, Real{-1.0});
        next.is_up = -at.next_shoulder - at.next_both > 1.0;
        s = next;
        return reward;
    }

    template <class L>
    static typename L::Bool terminated(const State<L>& s) {
        return s.is_up;
    }
    // The step keeps the speeds within their bounds.
    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        const double values[] = {lane_of(s.angle, lane), lane_of(s.bend, lane),
                                 lane_of(s.speed, lane), lane_of(s.bend_speed, lane),
                                 lane_of(s.push, lane),  lane_of(s.bend_push, lane)};
        std::memcpy(record, values, sizeof values);
    }
};

}  // namespace handwritten
