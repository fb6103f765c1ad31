// UAV_ippc2023 5: 40 aircraft. Ten are controlled, in registers of their own; the others walk at
// random, with 210 normal numbers a step, in the order of the draws. Both are objects of one
// environment, also in a batch, whose environments follow each other.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

#include <rddl/random/distributions/normal_quantile.hpp>

namespace handwritten {

struct Uav {
    static constexpr int width = 8;
    static constexpr std::uint64_t horizon = 100;
    static constexpr bool stochastic = true;
    static constexpr std::size_t aircraft = 40, controlled = std::size(uav::controlled);
    static constexpr double limit = 50000, dt = 0.1;

    // By the site of their draws.
    enum Kind : std::size_t { roll, x, y, z, yaw, pitch, speed, kinds };
    static constexpr Kind of_record[kinds] = {x, y, z, pitch, roll, yaw, speed};

    // Controlled aircraft.
    static constexpr int places = 16;
    using Real = rddl::Lanes<double, places>;
    using Mask = rddl::Mask<places>;
    static_assert(controlled <= places);

    static constexpr auto is_controlled = [](std::size_t craft) {
        return std::find(std::begin(uav::controlled), std::end(uav::controlled), craft) !=
               std::end(uav::controlled);
    };

    // A lane makes the draws of two neighbours, unless both are controlled.
    static constexpr int n = lanes_in_one;
    using Word = rddl::Lanes<std::uint64_t, n>;
    using Walk = rddl::Lanes<double, n>;
    static constexpr std::size_t draws_of_kind = [] {
        std::size_t count = 0;
        for (std::size_t k = 0; k < aircraft; k += 2)
            count += !(is_controlled(k) && is_controlled(k + 1));
        return count;
    }();
    static constexpr std::size_t registers = (kinds * draws_of_kind + n - 1) / n;
    struct Order {
        std::uint64_t site[registers * n], block[registers * n];
        // Who gets both numbers of each lane; the kind is `kinds` where they are not needed.
        std::size_t kind[2 * registers][n], craft[2 * registers][n];
        std::uint64_t walks[2 * registers], places[2 * registers], speeds[2 * registers];
    };
    static constexpr Order order = [] {
        Order all{};
        for (auto& row : all.kind)
            for (std::size_t& kind : row) kind = kinds;
        std::size_t at = 0;
        for (std::size_t kind = 0; kind < kinds; ++kind)
            for (std::size_t block = 0; block < aircraft / 2; ++block) {
                if (is_controlled(2 * block) && is_controlled(2 * block + 1)) continue;
                all.site[at] = kind;
                all.block[at] = block;
                for (std::size_t odd = 0; odd < 2; ++odd) {
                    if (is_controlled(2 * block + odd)) continue;
                    const std::size_t row = at / n * 2 + odd, lane = at % n;
                    const std::uint64_t bit = std::uint64_t{1} << lane;
                    all.kind[row][lane] = kind;
                    all.craft[row][lane] = 2 * block + odd;
                    all.walks[row] |= bit;
                    if (kind == x || kind == y || kind == z) all.places[row] |= bit;
                    if (kind == speed) all.speeds[row] |= bit;
                }
                ++at;
            }
        return all;
    }();

    struct One {
        Walk walks[2 * registers];
        Real own[kinds];
        bool is_outside;
    };
    template <class L>
    static constexpr bool is_one = std::is_same_v<L, rddl::Scalar>;
    template <class L>
    struct State {
        One of[is_one<L> ? 1 : width];
    };
    template <class L>
    struct Actions {
        const double* records;
    };
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        actions.records = reinterpret_cast<const double*>(records);
    }

    static inline const One first = [] {
        One one{};
        for (std::size_t row = 0; row < 2 * registers; ++row)
            for (int lane = 0; lane < n; ++lane)
                if (order.kind[row][lane] != kinds)
                    one.walks[row].set(lane,
                                       uav::start[order.kind[row][lane]][order.craft[row][lane]]);
        for (std::size_t kind = 0; kind < kinds; ++kind)
            for (std::size_t k = 0; k < controlled; ++k)
                one.own[kind].set(static_cast<int>(k), uav::start[kind][uav::controlled[k]]);
        return one;
    }();
    static void start(State<rddl::Scalar>& s) { s.of[0] = first; }
    template <class L>
    static void start(State<L>& s, typename L::Bool where) {
        rddl::for_each_lane(where, [&](int lane) { s.of[lane] = first; });
    }

    // ------------------------------------------------------------------- one environment

    static Mask is_beyond(const Real& place) { return !(rddl::absolute(place) <= Real{limit}); }
    static Real chosen(const double* actions, double most) {
        double wanted[places]{};
        for (std::size_t k = 0; k < controlled; ++k) wanted[k] = actions[uav::controlled[k]];
        return dt * larger(smaller(Real::load(wanted), most), -most);
    }
    static Real goal(std::size_t axis) {
        double values[places]{};
        std::copy_n(uav::goal[axis], controlled, values);
        return Real::load(values);
    }
    static double distance_to_goals(const Real (&own)[kinds]) {
        const Real dx = own[x] - goal(0), dy = own[y] - goal(1), dz = own[z] - goal(2);
        const Real distance = rddl::sqrt(dx * dx + dy * dy + dz * dz);
        double sum = 0;
        for (std::size_t k = 0; k < controlled; ++k) sum += distance[static_cast<int>(k)];
        return sum;
    }
    static void steer(One& one, const double* actions) {
        const Real turn = dt * (rddl::tan(one.own[roll]) / (one.own[speed] + 0.001)) * 9.8;
        const Real way = dt * one.own[speed];
        const bool is_great = any(!(rddl::absolute(one.own[yaw]) < Real{0x1p24}));
        const SinCos<Real> along =
            is_great ? SinCos<Real>{rddl::sin(one.own[yaw]), rddl::cos(one.own[yaw])}
                     : sin_cos(one.own[yaw]);
        one.own[x] = one.own[x] + way * along.cos;
        one.own[y] = one.own[y] + way * along.sin;
        one.own[z] = one.own[z] + way * rddl::sin(one.own[pitch]);
        one.own[yaw] = one.own[yaw] + turn;
        one.own[speed] = larger(one.own[speed] + chosen(actions, 10), 0);
        one.own[roll] = one.own[roll] + chosen(actions + aircraft, 1);
        one.own[pitch] = one.own[pitch] + chosen(actions + 2 * aircraft, 1);
        one.is_outside =
            (is_beyond(one.own[x]) || is_beyond(one.own[y]) || is_beyond(one.own[z])).bits &
            first_bits(controlled);
    }
    static inline const double deviation = std::sqrt(uav::variance);
    static void walk(One& one, const Draws<std::uint64_t>& draws) {
        const Draws<Word> many{Word{draws.step}, {Word{draws.key[0]}, Word{draws.key[1]}}};
        Walk steps[2 * registers];
        for (std::size_t r = 0; r < registers; ++r) {
            const auto numbers =
                many.two(Word::load(order.site + r * n), Word::load(order.block + r * n));
            steps[2 * r] = rddl::open_unit_real(numbers.even);
            steps[2 * r + 1] = rddl::open_unit_real(numbers.odd);
        }
        rddl::replace_by_normal_quantiles<2 * registers>(steps, 2 * registers);
        std::uint64_t outside = 0;
        for (std::size_t r = 0; r < 2 * registers; ++r) {
            Walk value = one.walks[r] + deviation * steps[r];
            if (order.speeds[r] != 0)
                value = select(rddl::Mask<n>::of_bits(order.speeds[r]), larger(value, 0), value);
            if (order.places[r] != 0)
                outside |= (!(rddl::absolute(value) <= Walk{limit})).bits & order.places[r];
            one.walks[r] = value;
        }
        one.is_outside |= outside != 0;
    }
    static double step_one(One& one, const double* actions, const Draws<std::uint64_t>& draws) {
        const double distance = distance_to_goals(one.own);
        steer(one, actions);
        walk(one, draws);
        return -distance;
    }

    // ------------------------------------------------------------------ one after the other

    static double step(State<rddl::Scalar>& s, const Actions<rddl::Scalar>& actions,
                       const Draws<std::uint64_t>& draws) {
        return step_one(s.of[0], actions.records, draws);
    }
    template <class L>
    static typename L::Real step(State<L>& s, const Actions<L>& actions,
                                 const Draws<typename L::Word>& draws) {
        double values[width];
        for (int lane = 0; lane < width; ++lane)
            values[lane] = step_one(s.of[lane], actions.records + std::size_t(lane) * 3 * aircraft,
                                    {draws.step[lane], {draws.key[0][lane], draws.key[1][lane]}});
        return L::Real::load(values);
    }
    template <class L>
    static typename L::Bool terminated(const State<L>&) {
        return typename L::Bool(false);
    }
    static bool broken(const State<rddl::Scalar>& s) { return s.of[0].is_outside; }
    template <class L>
    static typename L::Bool broken(const State<L>& s) {
        typename L::Bool all(false);
        for (int lane = 0; lane < width; ++lane) all.set(lane, s.of[lane].is_outside);
        return all;
    }

    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        const One& one = s.of[lane];
        double all[kinds][aircraft];
        for (std::size_t row = 0; row < 2 * registers; ++row)
            for (int k = 0; k < n; ++k)
                if (order.kind[row][k] != kinds)
                    all[order.kind[row][k]][order.craft[row][k]] = one.walks[row][k];
        for (std::size_t kind = 0; kind < kinds; ++kind)
            for (std::size_t k = 0; k < controlled; ++k)
                all[kind][uav::controlled[k]] = one.own[kind][static_cast<int>(k)];
        for (const Kind kind : of_record) {
            std::memcpy(record, all[kind], sizeof all[kind]);
            record += sizeof all[kind];
        }
    }
};

}  // namespace handwritten
