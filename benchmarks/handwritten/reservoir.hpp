// Reservoir_ippc2023 5: 30 reservoirs.
#pragma once

#include "reference.hpp"
#include "registers.hpp"
#include "tables.hpp"

#include <rddl/random/distributions/normal_quantile.hpp>

#include <array>
#include <cmath>

namespace handwritten {

struct Reservoir : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 100;
    static constexpr bool stochastic = true;
    static constexpr std::size_t count = std::size(reservoir::top_res);

    template <class L>
    struct State {
        typename L::Real level[count];
    };
    template <class L>
    struct Actions {
        typename L::Real release[count];
    };

    static void start(State<rddl::Scalar>& state) {
        for (std::size_t r = 0; r < count; ++r) state.level[r] = reservoir::rlevel[r];
    }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        for (std::size_t r = 0; r < count; ++r)
            state.level[r] = select(where, reservoir::rlevel[r], state.level[r]);
    }

    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        std::memcpy(actions.release, record, sizeof actions.release);
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        const auto* const values = reinterpret_cast<const double*>(records);
        const typename L::Int rows = row_starts<L>(count);
        for (std::size_t r = 0; r < count; ++r) actions.release[r] = gather(values + r, rows);
    }

    // The instance's data for a step, without divisions; which other reservoirs flow into each.
    struct Tables {
        double outflow[count], evaporation[count];
        int sources[count * count], ends[count];
    };
    static constexpr Tables tables = [] {
        Tables all{};
        int end = 0;
        for (std::size_t r = 0; r < count; ++r) {
            all.outflow[r] = 1 / reservoir::outlets[r];
            all.evaporation[r] = reservoir::evaporation / reservoir::top_res[r];
            for (std::size_t in = 0; in < count; ++in)
                if (reservoir::sources[r] >> in & 1) all.sources[end++] = static_cast<int>(in);
            all.ends[r] = end;
        }
        return all;
    }();
    // The variance of the rain is the same everywhere.
    static inline const double rain_deviation = std::sqrt(reservoir::rain_var[0]);

    template <class Real>
    static Real rain_of(const Real& number) {
        return rain_deviation * rddl::absolute(rddl::normal_quantile(rddl::open_unit_real(number)));
    }

    // Registers over the reservoirs.
    template <class Draws>
    static void draw_rain(const Draws& draws, double (&rain)[count]) {
        constexpr int n = lanes_in_one;
        using Word = rddl::Lanes<std::uint64_t, n>;
        const handwritten::Draws<Word> many{Word{draws.step},
                                            {Word{draws.key[0]}, Word{draws.key[1]}}};
        for (std::size_t first = 0; first < count; first += 2 * n) {
            const auto numbers = many.two(Word{std::uint64_t{0}}, counting_from<n>(first / 2));
            const auto even = rain_of(numbers.even), odd = rain_of(numbers.odd);
            for (int lane = 0; lane < n; ++lane) {
                const std::size_t r = first + 2 * static_cast<std::size_t>(lane);
                if (r >= count) break;
                rain[r] = even[lane];
                rain[r + 1] = odd[lane];
            }
        }
    }
    // Registers over environments.
    template <int n, class Draws>
    static void draw_rain(const Draws& draws, rddl::Lanes<double, n> (&rain)[count]) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        for (std::size_t r = 0; r < count; r += 2) {
            const auto numbers = draws.two(Word{std::uint64_t{0}}, Word{std::uint64_t{r / 2}});
            rain[r] = rain_of(numbers.even);
            rain[r + 1] = rain_of(numbers.odd);
        }
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& state, const Actions<L>& actions, const Draws& draws) {
        using Real = typename L::Real;
        Real rain[count], outflow[count], rest[count];
        draw_rain(draws, rain);
        for (std::size_t r = 0; r < count; ++r) {
            const Real level = state.level[r], release = actions.release[r];
            const Real released = larger(select(level < release, level, release), 0.0);
            const Real overflow = larger(level - released - reservoir::top_res[r], 0.0);
            outflow[r] = released * tables.outflow[r];
            rest[r] = level + rain[r] - level * tables.evaporation[r] - overflow - released;
        }
        Real penalty{0.0};
        for (std::size_t r = 0, source = 0; r < count; ++r) {
            Real inflow{0.0};
            for (; source < static_cast<std::size_t>(tables.ends[r]); ++source)
                inflow = inflow + outflow[tables.sources[source]];
            const Real level = smaller(larger(rest[r] + inflow, 0.0), reservoir::top_res[r]);
            penalty = penalty +
                      reservoir::low_cost[r] * larger(reservoir::min_level[r] - level, 0.0) +
                      reservoir::high_cost[r] * larger(level - reservoir::max_level[r], 0.0);
            state.level[r] = level;
        }
        return penalty;
    }

    // The step keeps the levels within their bounds.
    template <class L>
    static void store(const State<L>& state, std::int64_t lane, std::byte* record) {
        double values[count];
        for (std::size_t r = 0; r < count; ++r) values[r] = lane_of(state.level[r], lane);
        std::memcpy(record, values, sizeof values);
    }
};

}  // namespace handwritten
