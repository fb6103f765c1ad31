// SysAdmin_MDP_ippc2011 10: 50 computers, a bit each.
#pragma once

#include "reference.hpp"
#include "registers.hpp"
#include "tables.hpp"

#include <array>

namespace handwritten {

struct SysAdmin : RunsToTheHorizon {
    static constexpr int width = 8;
    static constexpr std::uint64_t horizon = 40;
    static constexpr bool stochastic = true;
    static constexpr std::size_t computers = std::size(sysadmin::neighbours);

    template <class L>
    struct State {
        typename L::Word running;
    };
    template <class L>
    struct Actions {
        typename L::Word reboot;
    };

    // A running computer keeps running with probability base + per_neighbour * running neighbours.
    struct Chances {
        std::array<double, 64> base, per_neighbour;
    };
    static constexpr Chances chances = [] {
        Chances all{};
        for (std::size_t x = 0; x < computers; ++x) {
            const double count = __builtin_popcountll(sysadmin::neighbours[x]);
            all.per_neighbour[x] = 0.5 / (1 + count);
            all.base[x] = 0.45 + all.per_neighbour[x];
        }
        return all;
    }();

    static constexpr std::uint64_t everywhere = (std::uint64_t{1} << computers) - 1;

    // Alone, the state has the even computers in its lower half and the odd ones in its upper half,
    // since one counter value of the generator serves two neighbours.

    static void start(State<rddl::Scalar>& state) { state.running = halves(everywhere); }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        state.running = select(where, everywhere, state.running);
    }

    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        actions.reboot = halves(bits_of_bytes<computers>(record));
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        for (int lane = 0; lane < L::width; ++lane)
            actions.reboot.set(lane, bits_of_bytes<computers>(records + lane * computers));
    }

    // Registers over the computers.
    struct Tables {
        static constexpr std::size_t half = 32;
        std::array<std::uint64_t, 2 * half> neighbours;
        Chances chances;
    };
    static constexpr Tables by_halves = [] {
        Tables tables{};
        for (std::size_t x = 0; x < computers; ++x) {
            const std::size_t place = x / 2 + x % 2 * Tables::half;
            tables.neighbours[place] = halves(sysadmin::neighbours[x]);
            tables.chances.base[place] = chances.base[x];
            tables.chances.per_neighbour[place] = chances.per_neighbour[x];
        }
        return tables;
    }();

    template <class Draws>
    static double step(State<rddl::Scalar>& state, const Actions<rddl::Scalar>& actions,
                       const Draws& draws) {
        constexpr int n = lanes_in_one;
        using Word = rddl::Lanes<std::uint64_t, n>;
        using Real = rddl::Lanes<double, n>;
        const std::uint64_t running = state.running, down = ~running;
        const handwritten::Draws<Word> many{Word{draws.step},
                                            {Word{draws.key[0]}, Word{draws.key[1]}}};
        std::uint64_t next = actions.reboot;
        for (std::size_t first = 0; 2 * first < computers; first += n) {
            const auto numbers = many.two(Word{std::uint64_t{0}}, counting_from<n>(first));
            for (std::size_t half : {std::size_t{0}, Tables::half}) {
                const std::size_t at = first + half;
                const Word count = bit_count(Word{running} & Word::load(&by_halves.neighbours[at]));
                const Real chance =
                    Real::load(&by_halves.chances.base[at]) +
                    Real::load(&by_halves.chances.per_neighbour[at]) * real_of_count(count);
                const Real number = half == 0 ? numbers.even : numbers.odd;
                next |= (std::uint64_t{(number < chance).bits} << at) & running;
                next |= (std::uint64_t{(number < sysadmin::reboot).bits} << at) & down;
            }
        }
        state.running = next & halves(everywhere);
        return static_cast<double>(bit_count(running)) -
               0.75 * static_cast<double>(bit_count(actions.reboot));
    }

    // Registers over environments.
    template <int n, class Draws>
    static rddl::Lanes<double, n> step(State<rddl::Pack<n>>& state,
                                       const Actions<rddl::Pack<n>>& actions, const Draws& draws) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        const Word running = state.running;
        Word next = actions.reboot;
        for (std::uint64_t x = 0; x < computers; x += 2) {
            const auto numbers = draws.two(Word{std::uint64_t{0}}, Word{x / 2});
            next = next | goes_on(running, x, numbers.even);
            next = next | goes_on(running, x + 1, numbers.odd);
        }
        state.running = next;
        return real_of_count(bit_count(running)) - 0.75 * real_of_count(bit_count(actions.reboot));
    }

    template <int n>
    static rddl::Lanes<std::uint64_t, n> goes_on(const rddl::Lanes<std::uint64_t, n>& running,
                                                 std::uint64_t x,
                                                 const rddl::Lanes<double, n>& number) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        const auto count = real_of_count(bit_count(running & Word{sysadmin::neighbours[x]}));
        const auto is_down = same(running & Word{std::uint64_t{1} << x}, Word{std::uint64_t{0}});
        const auto chance = select(is_down, rddl::Lanes<double, n>{sysadmin::reboot},
                                   chances.base[x] + chances.per_neighbour[x] * count);
        return select(number < chance, std::uint64_t{1} << x, std::uint64_t{0});
    }

    static void store(const State<rddl::Scalar>& state, std::int64_t, std::byte* record) {
        const std::uint64_t bits = to_even_bits(state.running) | to_even_bits(state.running >> 32)
                                                                     << 1;
        store_bits_as_bytes<computers>(bits, record);
    }
    template <class L>
    static void store(const State<L>& state, std::int64_t lane, std::byte* record) {
        store_bits_as_bytes<computers>(lane_of(state.running, lane), record);
    }
};

}  // namespace handwritten
