// Wildfire_MDP_ippc2014 10: 36 cells, two bits each.
#pragma once

#include "reference.hpp"
#include "registers.hpp"
#include "tables.hpp"

#include <array>
#include <cmath>

namespace handwritten {

struct Wildfire : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 40;
    static constexpr bool stochastic = true;
    static constexpr std::size_t cells = std::size(wildfire::neighbours);
    static constexpr std::uint64_t everywhere = (std::uint64_t{1} << cells) - 1;
    static constexpr std::uint64_t targets = wildfire::targets[0];

    template <class L>
    struct State {
        typename L::Word burning, out_of_fuel;
    };
    template <class L>
    struct Actions {
        typename L::Word put_out, cut_out;
    };

    static void start(State<rddl::Scalar>& state) { state = {wildfire::initially_burning[0], 0}; }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        state = {select(where, wildfire::initially_burning[0], state.burning),
                 select(where, std::uint64_t{0}, state.out_of_fuel)};
    }

    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        actions = {bits_of_bytes<cells>(record), bits_of_bytes<cells>(record + cells)};
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        for (int lane = 0; lane < L::width; ++lane) {
            Actions<rddl::Scalar> one;
            load(one, records + lane * 2 * cells);
            actions.put_out.set(lane, one.put_out);
            actions.cut_out.set(lane, one.cut_out);
        }
    }

    // The probability of catching fire, by the number of burning neighbours; a target needs one.
    static constexpr std::size_t kind_size = 16;
    static inline const std::array<double, 2 * kind_size> chances = [] {
        std::array<double, 2 * kind_size> all{};
        for (std::size_t count = 0; count < kind_size; ++count) {
            all[count] = 1.0 / (1.0 + std::exp(4.5 - static_cast<double>(count)));
            all[kind_size + count] = count == 0 ? 0.0 : all[count];
        }
        return all;
    }();
    template <class Word>
    struct Costs {
        Word cut, put_out, targets, others;
    };
    template <class Word>
    static auto reward(const Costs<Word>& where) {
        return -5.0 * real_of_count(bit_count(where.cut)) -
               10.0 * real_of_count(bit_count(where.put_out)) -
               100.0 * real_of_count(bit_count(where.targets)) -
               5.0 * real_of_count(bit_count(where.others));
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& state, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        const Word grid{everywhere}, target{targets}, other{everywhere & ~targets};
        const Word touched = state.burning | state.out_of_fuel;
        const Word may_catch = grid ^ (touched | actions.put_out);
        const Word caught = catching(state.burning, may_catch, draws);
        const auto value = reward(
            Costs<Word>{actions.cut_out, actions.put_out, touched & target, state.burning & other});
        const Word kept = state.burning ^ (state.burning & actions.put_out);
        state = {kept | caught, touched | (actions.cut_out & other)};
        return value;
    }

    // Registers over the cells: even ones in the lower half, odd ones in the upper half, since one
    // number of the generator serves two neighbours.
    struct Tables {
        static constexpr std::size_t half = 32;
        std::array<std::uint64_t, 2 * half> neighbours, kinds;
    };
    static constexpr Tables by_halves = [] {
        Tables tables{};
        for (std::size_t cell = 0; cell < cells; ++cell) {
            const std::size_t place = cell / 2 + cell % 2 * Tables::half;
            tables.neighbours[place] = wildfire::neighbours[cell];
            tables.kinds[place] = (targets >> cell & 1) * kind_size;
        }
        return tables;
    }();

    template <class Draws>
    static std::uint64_t catching(std::uint64_t burning, std::uint64_t may_catch,
                                  const Draws& draws) {
        constexpr int n = lanes_in_one;
        using Word = rddl::Lanes<std::uint64_t, n>;
        const handwritten::Draws<Word> many{Word{draws.step},
                                            {Word{draws.key[0]}, Word{draws.key[1]}}};
        std::uint64_t even = 0, odd = 0;
        for (std::size_t first = 0; 2 * first < cells; first += n) {
            const std::uint64_t both = (std::uint64_t{1} << 2 * n) - 1;
            if ((may_catch >> 2 * first & both) == 0) continue;
            const auto numbers = many.two(Word{std::uint64_t{0}}, counting_from<n>(first));
            const auto below = [&](std::size_t at, const auto& number) {
                const Word count = bit_count(Word{burning} & Word::load(&by_halves.neighbours[at]));
                const Word row = count + Word::load(&by_halves.kinds[at]);
                return std::uint64_t{(number < gather(chances.data(), rddl::ints_of(row))).bits};
            };
            even |= below(first, numbers.even) << first;
            odd |= below(first + Tables::half, numbers.odd) << first;
        }
        return may_catch & (joined_halves(even | odd << Tables::half));
    }

    // Registers over environments.
    template <int n, class Draws>
    static rddl::Lanes<std::uint64_t, n> catching(const rddl::Lanes<std::uint64_t, n>& burning,
                                                  const rddl::Lanes<std::uint64_t, n>& may_catch,
                                                  const Draws& draws) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        const Word none{std::uint64_t{0}};
        Word caught = none;
        for (std::uint64_t cell = 0; cell < cells; cell += 2) {
            if (all(same(may_catch & Word{std::uint64_t{3} << cell}, none))) continue;
            const auto numbers = draws.two(none, Word{cell / 2});
            const auto below = [&](std::uint64_t at, const auto& number) {
                const Word count = bit_count(burning & Word{wildfire::neighbours[at]});
                const auto row = rddl::ints_of(count + Word{(targets >> at & 1) * kind_size});
                const auto chance = gather(chances.data(), row);
                return select(number < chance, std::uint64_t{1} << at, std::uint64_t{0});
            };
            caught = caught | below(cell, numbers.even) | below(cell + 1, numbers.odd);
        }
        return caught & may_catch;
    }

    template <class L>
    static void store(const State<L>& state, std::int64_t lane, std::byte* record) {
        store_bits_as_bytes<cells>(lane_of(state.burning, lane), record);
        store_bits_as_bytes<cells>(lane_of(state.out_of_fuel, lane), record + cells);
    }
};

}  // namespace handwritten
