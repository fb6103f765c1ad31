// Option_or 1: an option on the dearer of two stocks.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

#include <rddl/random/distributions/normal_quantile.hpp>

namespace handwritten {

struct Option : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 62;
    static constexpr bool stochastic = true;

    template <class L>
    struct State {
        typename L::Real first, second, time;
        typename L::Bool exercised;
    };
    template <class L>
    struct Actions {
        typename L::Bool exercise;
    };

    static void start(State<rddl::Scalar>& s) { s = {option::price, option::price, 0.0, false}; }
    template <class L>
    static void start(State<L>& s, typename L::Bool where) {
        s = {select(where, option::price, s.first), select(where, option::price, s.second),
             select(where, 0.0, s.time), s.exercised && !where};
    }

    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        actions.exercise = *record != std::byte{0};
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        actions.exercise = L::Bool::of_bits(bits_of_bytes<L::width>(records));
    }

    template <class Real>
    struct Growth {
        Real first, second;
    };
    template <class Real>
    static Real normal(const Real& number) {
        return rddl::normal_quantile(rddl::open_unit_real(number));
    }
    // The two stocks of one environment, in a register.
    static Growth<double> growth(const rddl::TwoDraws<double>& numbers) {
        using Real = rddl::Lanes<double, lanes_in_one>;
        const auto pair = [](double even, double odd) {
            Real both{odd};
            both.set(0, even);
            return both;
        };
        const Real normals = normal(pair(numbers.even, numbers.odd));
        const Real factors = rddl::exp(pair(option::drift[0], option::drift[1]) +
                                       pair(option::factor[0], option::factor[2]) * normals +
                                       pair(option::factor[1] * normals[1], 0.0));
        return {factors[0], factors[1]};
    }
    template <int n>
    static Growth<rddl::Lanes<double, n>> growth(
        const rddl::TwoDraws<rddl::Lanes<double, n>>& numbers) {
        const auto first = normal(numbers.even), second = normal(numbers.odd);
        return {
            rddl::exp(option::drift[0] + option::factor[0] * first + option::factor[1] * second),
            rddl::exp(option::drift[1] + option::factor[2] * second)};
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws& draws) {
        using Real = typename L::Real;
        using Word = typename L::Word;
        const auto exercised = s.exercised || actions.exercise || s.time >= option::maturity;
        const Real dearer = select(s.first < s.second, s.second, s.first);
        const Real payoff = larger(dearer - option::strike, 0.0);
        const Real reward = select(exercised && !s.exercised, payoff, Real{0.0});
        const auto factors = growth(draws.two(Word{std::uint64_t{0}}, Word{std::uint64_t{0}}));
        s = {s.first * factors.first, s.second * factors.second, s.time + option::delta, exercised};
        return reward;
    }

    static bool lane_of_bool(bool value, std::int64_t) { return value; }
    template <int n>
    static bool lane_of_bool(const rddl::Mask<n>& mask, std::int64_t lane) {
        return mask.bits >> lane & 1;
    }
    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        const double values[] = {lane_of(s.first, lane), lane_of(s.second, lane),
                                 lane_of(s.time, lane)};
        std::memcpy(record, values, sizeof values);
        record[sizeof values] = std::byte{lane_of_bool(s.exercised, lane)};
    }
};

}  // namespace handwritten
