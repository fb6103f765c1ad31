// Quadcopter_physics 1: four drones. Small errors of angles grow from step to step, so angles are
// computed in the order of the text; places, which turn no drone, as is best.
#pragma once

#include "reference.hpp"
#include "registers.hpp"
#include "tables.hpp"

namespace handwritten {

struct Quadcopter : RunsToTheHorizon {
    static constexpr int width = 8;
    static constexpr std::uint64_t horizon = 200;
    static constexpr bool stochastic = false;
    static constexpr int drones = 4, axes = 3, propellers = 4;

    static constexpr double most = 1000000, dt = 0.01, gravity = 9.8, friction = 4, thrust = 0.01,
                            drag = 0.001, arm = 0.3;
    static constexpr double center = 0.3, rotor = 0.1, radius = 0.15, mass = center + 4 * rotor;
    static constexpr double inertia = 0.4 * center * (radius * radius) + 2 * (arm * arm) * rotor;
    static constexpr double inertia_z = 0.4 * center * (radius * radius) + 4 * (arm * arm) * rotor;
    static constexpr double near = (2 * arm * 2) * (2 * arm * 2);

    // One drone of an environment, or all four in a register; or one of several environments.
    template <class R>
    struct Angles {
        R phi, theta, psi;
    };
    template <class R>
    struct Powers {
        R of[propellers];
    };

    // By axis, then by drone: places, velocities, angles and their velocities, as in the record.
    template <class L>
    struct State {
        using Real = typename L::Real;
        Real place[axes][drones], speed[axes][drones], angle[axes][drones], turn[axes][drones];
    };
    template <class L>
    struct Actions {
        const double* records;
    };

    static void start(State<rddl::Scalar>& s) {
        s = {};
        std::memcpy(s.place, quadcopter::start, sizeof s.place);
    }
    template <class L>
    static void start(State<L>& s, typename L::Bool where) {
        for (int axis = 0; axis < axes; ++axis)
            for (int d = 0; d < drones; ++d) {
                s.place[axis][d] = select(where, quadcopter::start[axis][d], s.place[axis][d]);
                for (auto* of : {&s.speed, &s.angle, &s.turn})
                    (*of)[axis][d] = select(where, 0.0, (*of)[axis][d]);
            }
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        actions.records = reinterpret_cast<const double*>(records);
    }

    template <class R>
    static R bounded(const R& a) {
        return smaller(larger(a, -most), most);
    }
    using Four = rddl::Lanes<double, drones>;
    static Four bounded(Four a) {
        const typename Four::Vector high = Four{most}.part[0], low = -high;
        auto& values = a.part[0];
        values = values > low ? values : low;
        values = values < high ? values : high;
        return a;
    }
    template <class R>
    static R sum_of_squares(const R& a, const R& b, const R& c) {
        return a * a + b * b + c * c;
    }

    // The next velocities of angles.
    template <class R>
    static Angles<R> turn(const Angles<R>& was, const SinCos<R>& phi, const SinCos<R>& theta,
                          const Powers<R>& power) {
        const R x = was.phi - theta.sin * was.psi;
        const R y = phi.cos * was.theta + theta.cos * phi.sin * was.psi;
        const R z = theta.cos * phi.cos * was.psi - phi.sin * was.theta;
        constexpr double lever = arm * thrust, ratio_x = (inertia - inertia_z) / inertia,
                         ratio_y = (inertia_z - inertia) / inertia;
        const auto& p = power.of;
        const R push_x = lever * (p[0] - p[2]), push_y = lever * (p[1] - p[3]);
        const R push_z = drag * (p[0] - p[1] + p[2] - p[3]);
        const R next_x = x + dt * (push_x / R{inertia} - ratio_x * y * z);
        const R next_y = y + dt * (push_y / R{inertia} - ratio_y * x * z);
        const R next_z = z + dt * (push_z / R{inertia_z});
        return {bounded(next_x + theta.sin * phi.sin / theta.cos * next_y +
                        theta.sin * phi.cos / theta.cos * next_z),
                bounded(phi.cos * next_y - phi.sin * next_z),
                bounded(phi.sin / theta.cos * next_y + phi.cos / theta.cos * next_z)};
    }
    // How much faster it gets; legal powers do not reach the limits.
    template <class R>
    struct Push {
        R x, y, z;
    };
    template <class R>
    static Push<R> push(const SinCos<R>& theta, const SinCos<R>& psi, const Powers<R>& power) {
        const auto& p = power.of;
        const R all = (p[0] + p[1] + p[2] + p[3]) * (dt * thrust / mass), flat = theta.sin * all;
        return {flat * psi.sin, -(flat * psi.cos), theta.cos * all - R{dt * gravity}};
    }
    template <class R>
    static void move(R& place, R& speed, const R& push) {
        place = place + dt * speed;
        speed = speed * (1 - dt * friction) + push;
    }

    // ---------------------------------------------------------------- one environment

    static double sum(const Four& values) {
        return (values[0] + values[1]) + (values[2] + values[3]);
    }
    static double pairs_nearby(const double (&place)[axes][drones]) {
        Four next[axes], second[axes];
        for (int axis = 0; axis < axes; ++axis)
            for (int d = 0; d < drones; ++d) {
                next[axis].set(d, place[axis][(d + 1) % drones]);
                second[axis].set(d, place[axis][(d + 2) % drones]);
            }
        const auto nearby = [&](const Four(&other)[axes]) {
            const auto distance = [&](int axis) {
                return Four::load(place[axis]) - other[axis];
            };
            const Four squared = sum_of_squares(distance(0), distance(1), distance(2));
            return squared.part[0] <= Four{near}.part[0];  // -1 where they are
        };
        const auto one = nearby(next), two = nearby(second);
        return static_cast<double>(-(one[0] + one[1] + one[2] + one[3] + two[0] + two[1]));
    }

    template <class Draws>
    static double step(State<rddl::Scalar>& s, const Actions<rddl::Scalar>& actions, const Draws&) {
        const auto load = [](const auto& of, int axis) {
            return Four::load(of[axis]);
        };
        Powers<Four> power;
        for (int p = 0; p < propellers; ++p)
            for (int d = 0; d < drones; ++d) power.of[p].set(d, actions.records[4 * d + p]);
        // The angles of all drones in registers.
        using Twelve = rddl::Lanes<double, 16>;
        double angles[16]{}, sines[16], cosines[16];
        std::memcpy(angles, s.angle, sizeof s.angle);
        const auto all = sin_cos(Twelve::load(angles));
        all.sin.store(sines);
        all.cos.store(cosines);
        const auto of = [&](int axis) {
            return SinCos<Four>{Four::load(sines + drones * axis),
                                Four::load(cosines + drones * axis)};
        };
        const auto phi = of(0), theta = of(1), psi = of(2);

        const Four tilt = sum_of_squares(load(s.angle, 0), load(s.angle, 1), load(s.angle, 2));
        const Four wobble = sum_of_squares(load(s.turn, 0), load(s.turn, 1), load(s.turn, 2));
        const auto away = [&](int axis) {
            return load(s.place, axis) - Four::load(quadcopter::target[axis]);
        };
        const Four distance = sum_of_squares(away(0), away(1), away(2));
        const double reward =
            -20000.0 * pairs_nearby(s.place) - sum(distance + 0.0001 * (tilt + wobble));

        const auto faster = push(theta, psi, power);
        const auto turned =
            turn<Four>({load(s.turn, 0), load(s.turn, 1), load(s.turn, 2)}, phi, theta, power);
        for (int axis = 0; axis < axes; ++axis) {
            Four place = load(s.place, axis), speed = load(s.speed, axis);
            move(place, speed, axis == 0 ? faster.x : axis == 1 ? faster.y : faster.z);
            place.store(s.place[axis]);
            speed.store(s.speed[axis]);
            (load(s.angle, axis) + dt * load(s.turn, axis)).store(s.angle[axis]);
        }
        turned.phi.store(s.turn[0]);
        turned.theta.store(s.turn[1]);
        turned.psi.store(s.turn[2]);
        return reward;
    }

    // ------------------------------------------------------------ several environments

    template <int n, class Draws>
    static rddl::Lanes<double, n> step(State<rddl::Pack<n>>& s,
                                       const Actions<rddl::Pack<n>>& actions, const Draws&) {
        using L = rddl::Pack<n>;
        using Real = typename L::Real;
        const typename L::Int rows = row_starts<L>(drones * propellers);
        Real loss{0.0}, collisions{0.0};
        for (int d = 0; d < drones; ++d)
            for (int e = d + 1; e < drones; ++e) {
                const auto distance = [&](int axis) {
                    return s.place[axis][d] - s.place[axis][e];
                };
                const Real squared = sum_of_squares(distance(0), distance(1), distance(2));
                collisions = select(squared <= Real{near}, collisions + Real{20000.0}, collisions);
            }
        for (int d = 0; d < drones; ++d) {
            Powers<Real> power;
            for (int p = 0; p < propellers; ++p)
                power.of[p] = gather(actions.records + propellers * d + p, rows);
            const auto away = [&](int axis) {
                return s.place[axis][d] - Real{quadcopter::target[axis][d]};
            };
            const auto phi = sin_cos(s.angle[0][d]), theta = sin_cos(s.angle[1][d]),
                       psi = sin_cos(s.angle[2][d]);
            loss = loss + sum_of_squares(away(0), away(1), away(2)) +
                   0.0001 * (sum_of_squares(s.angle[0][d], s.angle[1][d], s.angle[2][d]) +
                             sum_of_squares(s.turn[0][d], s.turn[1][d], s.turn[2][d]));
            const auto faster = push(theta, psi, power);
            const auto turned =
                turn<Real>({s.turn[0][d], s.turn[1][d], s.turn[2][d]}, phi, theta, power);
            move(s.place[0][d], s.speed[0][d], faster.x);
            move(s.place[1][d], s.speed[1][d], faster.y);
            move(s.place[2][d], s.speed[2][d], faster.z);
            for (int axis = 0; axis < axes; ++axis)
                s.angle[axis][d] = s.angle[axis][d] + dt * s.turn[axis][d];
            s.turn[0][d] = turned.phi;
            s.turn[1][d] = turned.theta;
            s.turn[2][d] = turned.psi;
        }
        return -loss - collisions;
    }

    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        double values[4][axes][drones];
        for (int axis = 0; axis < axes; ++axis)
            for (int d = 0; d < drones; ++d) {
                values[0][axis][d] = lane_of(s.place[axis][d], lane);
                values[1][axis][d] = lane_of(s.speed[axis][d], lane);
                values[2][axis][d] = lane_of(s.angle[axis][d], lane);
                values[3][axis][d] = lane_of(s.turn[axis][d], lane);
            }
        std::memcpy(record, values, sizeof values);
    }
};

}  // namespace handwritten
