// PowerGen_ippc2023 5: 11 plants.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

#include <rddl/random/distributions/normal_quantile.hpp>

namespace handwritten {

struct PowerGen : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 100;
    static constexpr bool stochastic = true;
    static constexpr std::size_t plants = std::size(power_gen::least), room = 16;

    template <class L>
    struct State {
        typename L::Real output[room];  // those beyond the plants are 0
        typename L::Real temperature;
    };
    template <class L>
    struct Actions {
        typename L::Real wanted[room];
    };

    static void start(State<rddl::Scalar>& state) {
        state = {};
        state.temperature = power_gen::temperature;
    }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        for (auto& output : state.output) output = select(where, 0.0, output);
        state.temperature = select(where, double{power_gen::temperature}, state.temperature);
    }

    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        std::memcpy(actions.wanted, record, plants * sizeof(double));
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        const auto* const values = reinterpret_cast<const double*>(records);
        const typename L::Int rows = row_starts<L>(plants);
        for (std::size_t p = 0; p < plants; ++p) actions.wanted[p] = gather(values + p, rows);
    }

    // By plant, with zeros beyond the last.
    struct Tables {
        double least[room], greatest[room], scale[room], cost[room], change[room], turn_on[room];
    };
    static constexpr Tables tables = [] {
        Tables all{};
        for (std::size_t p = 0; p < plants; ++p) {
            all.least[p] = power_gen::least[p];
            all.greatest[p] = power_gen::greatest[p];
            all.scale[p] = power_gen::scale[p];
            all.cost[p] = power_gen::cost[p];
            all.change[p] = power_gen::change[p];
            all.turn_on[p] = power_gen::turn_on[p];
        }
        for (std::size_t p = plants; p < room; ++p) all.least[p] = 1;  // never on
        return all;
    }();

    template <class Real>
    struct Sums {
        Real output, other;  // all output; its cost, with what changes earn and turning on costs
    };
    template <class Real>
    static Real exponential(const Real& number) {
        return -rddl::ln(rddl::open_unit_real(number));
    }
    // One plant or several. A plant is on where its output is not 0, which its least output is not.
    template <class Real, class Table>
    static Real operate(Sums<Real>& sums, Real& output, const Real& wanted, const Real& number,
                        const Table& of) {
        const auto is_on = wanted >= of.least;
        const Real raised = wanted + of.scale * exponential(number);
        const Real capped = select(raised < of.greatest, raised, of.greatest);
        const Real bounded = select(capped > of.least, capped, of.least);
        const Real now = select(is_on, bounded, Real{0.0});
        const Real turning = select(is_on && output == 0.0, of.turn_on, Real{0.0});
        sums.output = sums.output + now;
        sums.other =
            sums.other + (rddl::absolute(now - output) * of.change - now * of.cost - turning);
        output = now;
        return now;
    }
    template <class Real>
    struct Plant {
        Real least, greatest, scale, cost, change, turn_on;
    };

    template <class Real>
    static Real reward(const Real& temperature, const Sums<Real>& sums) {
        const Real difference = temperature - power_gen::least_demand_temperature;
        const Real demand =
            power_gen::least_demand + power_gen::demand_factor * (difference * difference);
        const auto fulfilled = demand <= sums.output;
        return sums.other + power_gen::income * select(fulfilled, demand, sums.output) -
               select(fulfilled, Real{0.0}, Real{power_gen::penalty});
    }
    static inline const double deviation = std::sqrt(power_gen::temperature_variance);
    template <class Real>
    static Real next_temperature(const Real& temperature, const Real& number) {
        const Real next =
            temperature + deviation * rddl::normal_quantile(rddl::open_unit_real(number));
        return larger(smaller(next, power_gen::greatest_temperature), power_gen::least_temperature);
    }

    static double sum_of(const rddl::Lanes<double, lanes_in_one>& values) {
        double sum = 0;
        for (int lane = 0; lane < lanes_in_one; ++lane) sum += values[lane];
        return sum;
    }

    // Registers over the plants, even ones and odd ones. The draw of the temperature, which is
    // of another site, has a lane that no plants need.
    template <class Draws>
    static double step(State<rddl::Scalar>& s, const Actions<rddl::Scalar>& actions,
                       const Draws& draws) {
        constexpr int n = lanes_in_one, last = n - 1;
        using Word = rddl::Lanes<std::uint64_t, n>;
        using Real = rddl::Lanes<double, n>;
        static constexpr std::uint64_t sites[n] = {1, 1, 1, 1, 1, 1, 1, 0},
                                       blocks[n] = {0, 1, 2, 3, 4, 5, 6, 0};
        static constexpr auto halves = [] {
            std::array<std::array<std::array<double, n>, 6>, 2> all{};
            const double* const rows[] = {tables.least, tables.greatest, tables.scale,
                                          tables.cost,  tables.change,   tables.turn_on};
            for (std::size_t row = 0; row < 6; ++row)
                for (std::size_t p = 0; p < room; ++p) all[p % 2][row][p / 2] = rows[row][p];
            return all;
        }();
        const handwritten::Draws<Word> many{Word{draws.step},
                                            {Word{draws.key[0]}, Word{draws.key[1]}}};
        const auto numbers = many.two(Word::load(sites), Word::load(blocks));
        Sums<Real> sums{Real{0.0}, Real{0.0}};
        double wanted[2][n]{}, output[2][n]{};
        for (std::size_t p = 0; p < plants; ++p) {
            wanted[p % 2][p / 2] = actions.wanted[p];
            output[p % 2][p / 2] = s.output[p];
        }
        for (std::size_t half = 0; half < 2; ++half) {
            const auto row = [&](std::size_t k) {
                return Real::load(halves[half][k].data());
            };
            Real now = Real::load(output[half]);
            operate(sums, now, Real::load(wanted[half]), half == 0 ? numbers.even : numbers.odd,
                    Plant<Real>{row(0), row(1), row(2), row(3), row(4), row(5)});
            now.store(output[half]);
        }
        for (std::size_t p = 0; p < plants; ++p) s.output[p] = output[p % 2][p / 2];
        const double value =
            reward(s.temperature, Sums<double>{sum_of(sums.output), sum_of(sums.other)});
        s.temperature = next_temperature(s.temperature, numbers.even[last]);
        return value;
    }

    // Registers over environments.
    template <int n, class Draws>
    static rddl::Lanes<double, n> step(State<rddl::Pack<n>>& s,
                                       const Actions<rddl::Pack<n>>& actions, const Draws& draws) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        using Real = rddl::Lanes<double, n>;
        Sums<Real> sums{Real{0.0}, Real{0.0}};
        for (std::size_t p = 0; p < plants; p += 2) {
            const auto numbers = draws.two(Word{std::uint64_t{1}}, Word{std::uint64_t{p / 2}});
            for (std::size_t k = p; k < std::min(p + 2, plants); ++k)
                operate(sums, s.output[k], actions.wanted[k], k == p ? numbers.even : numbers.odd,
                        Plant<Real>{tables.least[k], tables.greatest[k], tables.scale[k],
                                    tables.cost[k], tables.change[k], tables.turn_on[k]});
        }
        const Real value = reward(s.temperature, sums);
        const auto number = draws.two(Word{std::uint64_t{0}}, Word{std::uint64_t{0}}).even;
        s.temperature = next_temperature(s.temperature, number);
        return value;
    }

    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        double outputs[plants];
        for (std::size_t p = 0; p < plants; ++p) outputs[p] = lane_of(s.output[p], lane);
        std::memcpy(record, outputs, sizeof outputs);
        record += sizeof outputs;
        for (std::size_t p = 0; p < plants; ++p) record[p] = std::byte{outputs[p] != 0};
        const double temperature = lane_of(s.temperature, lane);
        std::memcpy(record + (plants + 7) / 8 * 8, &temperature, sizeof temperature);
    }
};

}  // namespace handwritten
