// SupplyChain_or 0: a factory and three warehouses.
#pragma once

#include "bools.hpp"

#include <cmath>

namespace handwritten {

struct SupplyChain : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 252;
    static constexpr bool stochastic = true;
    static constexpr std::size_t warehouses = 3;
    static constexpr std::int64_t capacity = 100, first_stock = 10, greatest_demand = 20;

    template <class L>
    struct State {
        typename L::Int epoch, old_demand[warehouses], demand[warehouses], factory,
            stock[warehouses];
    };
    template <class L>
    struct Actions {
        typename L::Int produce, ship[warehouses];
    };

    static void start(State<rddl::Scalar>& state) {
        state = {};
        state.factory = first_stock;
    }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        const std::int64_t none = 0;
        state.epoch = select(where, none, state.epoch);
        state.factory = select(where, first_stock, state.factory);
        for (std::size_t w = 0; w < warehouses; ++w) {
            state.old_demand[w] = select(where, none, state.old_demand[w]);
            state.demand[w] = select(where, none, state.demand[w]);
            state.stock[w] = select(where, none, state.stock[w]);
        }
    }

    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        std::memcpy(&actions, record, sizeof actions);
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        const auto* const values = reinterpret_cast<const std::int64_t*>(records);
        const typename L::Int rows = row_starts<L>(warehouses + 1);
        actions.produce = gather_integers(values, rows);
        for (std::size_t w = 0; w < warehouses; ++w)
            actions.ship[w] = gather_integers(values + 1 + w, rows);
    }

    // The demand at a warehouse by the epoch and twice its number, for both outcomes of the draw.
    static constexpr std::size_t epochs = horizon + 2 * warehouses + 1;
    static inline const auto demands = [] {
        std::array<std::int64_t, 2 * epochs> all{};
        for (std::size_t e = 0; e < epochs; ++e) {
            const double wave = 10 * std::sin(2 * 3.14159265 * static_cast<double>(e) / 12) + 10;
            for (std::size_t more = 0; more < 2; ++more)
                all[2 * e + more] = std::min(
                    static_cast<std::int64_t>(std::floor(wave + static_cast<double>(more))),
                    greatest_demand);
        }
        return all;
    }();
    static std::int64_t demand_at(std::int64_t at) { return demands[static_cast<std::size_t>(at)]; }
    template <int n>
    static rddl::Lanes<std::int64_t, n> demand_at(const rddl::Lanes<std::int64_t, n>& at) {
        return gather_integers(demands.data(), at);
    }

    // Trucks for what is shipped: a fifth of it, rounded up.
    static double trucks(std::int64_t shipped) {
        return std::ceil(static_cast<double>(shipped) * 0.2 - 0x1p-40);
    }
    template <int n>
    static rddl::Lanes<double, n> trucks(const rddl::Lanes<std::int64_t, n>& shipped) {
        return rddl::Lanes<double, n>::each([](auto x) { return -rddl::simd::floor(0x1p-40 - x); },
                                            rddl::to_real(shipped) * 0.2);
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        using Int = typename L::Int;
        const auto at_most = [](const Int& a, std::int64_t b) {
            return select(a < b, a, Int{b});
        };
        const auto at_least = [](const Int& a, std::int64_t b) {
            return select(a > b, a, Int{b});
        };
        const auto integer = [](std::uint64_t value) {
            return Word{value};
        };

        Int shipped = actions.ship[0];
        for (std::size_t w = 1; w < warehouses; ++w) shipped = shipped + actions.ship[w];
        const auto possible = shipped <= s.factory;
        shipped = select(possible, shipped, Int{0});

        const auto first = draws.two_integers(integer(0), integer(0)),
                   last = draws.two_integers(integer(0), integer(1));
        const Word* const numbers[warehouses] = {&first.even, &first.odd, &last.even};
        Int sold{0}, held = at_least(s.factory, 0), missing{0};
        auto all_trucks = trucks(Int{0});
        for (std::size_t w = 0; w < warehouses; ++w) {
            const Int ship = select(possible, actions.ship[w], Int{0});
            const auto more = is_below(*numbers[w], integer(threshold(0.5)));
            const Int at = s.epoch + Int{static_cast<std::int64_t>(2 * w + 2)};
            const Int demand = demand_at(at + at + select(more, Int{1}, Int{0}));
            sold = sold + demand;
            held = held + at_least(s.stock[w], 0);
            missing = missing + at_most(s.stock[w], 0);
            all_trucks = all_trucks + trucks(ship);
            s.stock[w] = at_most(s.stock[w] + ship - demand, capacity);
            s.old_demand[w] = s.demand[w];
            s.demand[w] = demand;
        }
        s.factory = at_least(at_most(s.factory + actions.produce - shipped, capacity), 0);
        s.epoch = s.epoch + Int{1};
        return rddl::to_real(sold) - 0.1 * rddl::to_real(actions.produce + held) +
               0.5 * rddl::to_real(missing) - 0.05 * all_trucks;
    }

    // The step keeps stocks and demands within their bounds.
    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        std::int64_t values[2 + 3 * warehouses];
        values[0] = lane_of(s.epoch, lane);
        values[1 + 2 * warehouses] = lane_of(s.factory, lane);
        for (std::size_t w = 0; w < warehouses; ++w) {
            values[1 + w] = lane_of(s.old_demand[w], lane);
            values[1 + warehouses + w] = lane_of(s.demand[w], lane);
            values[2 + 2 * warehouses + w] = lane_of(s.stock[w], lane);
        }
        std::memcpy(record, values, sizeof values);
    }
};

}  // namespace handwritten
