// RedFinnedBlueEye_ippc2018 20: 38 springs, two bits each: the fish that is to live there, and the
// one that is not. A spring is connected to few others, not far from it in their order.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct RedFinnedBlueEye : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 60;
    static constexpr bool stochastic = true;
    static constexpr std::size_t springs = red_finned_blue_eye::springs,
                                 levels = red_finned_blue_eye::levels, kinds = 3;
    static constexpr std::uint64_t everywhere = first_bits(springs), mortality_site = 4;

    template <class L>
    struct State {
        typename L::Word fish, gambusia, wait;
    };
    // Poisons, removes by hand, translocates: a bit for each spring.
    template <class L>
    struct Actions {
        typename L::Word of[kinds];
    };

    static void start(State<rddl::Scalar>& s) {
        s = {red_finned_blue_eye::fish, red_finned_blue_eye::gambusia, 0};
    }
    template <class L>
    static void start(State<L>& s, typename L::Bool where) {
        const std::uint64_t fish = red_finned_blue_eye::fish,
                            gambusia = red_finned_blue_eye::gambusia, none = 0;
        s = {select(where, fish, s.fish), select(where, gambusia, s.gambusia),
             select(where, none, s.wait)};
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        for (std::size_t kind = 0; kind < kinds; ++kind)
            load_words(actions.of[kind], records + kind * springs, kinds * springs,
                       bits_of_bytes<springs>);
    }

    static constexpr Thresholds mortality = Thresholds::of_chances(red_finned_blue_eye::mortality);
    static constexpr std::uint64_t success[kinds] = {threshold(red_finned_blue_eye::success[0]),
                                                     threshold(red_finned_blue_eye::success[1]),
                                                     threshold(red_finned_blue_eye::success[2])};
    // The numbers below limit k make level k or one before it.
    static constexpr auto level_limits = [] {
        std::array<std::uint64_t, levels> limits{};
        double sum = 0;
        for (std::size_t k = 0; k < levels; ++k)
            limits[k] = threshold(sum += red_finned_blue_eye::level_chances[k]);
        return limits;
    }();
    static_assert(level_limits[levels - 1] == threshold(1.0));

    template <class Word>
    static Word level_of(const Word& number) {
        Word level{std::uint64_t{0}};
        for (std::size_t k = 0; k + 1 < levels; ++k)
            level = level + select(is_below(number, Word{level_limits[k]}), Word{std::uint64_t{0}},
                                   Word{std::uint64_t{1}});
        return level;
    }

    // Both are drawn in each step.
    template <class Word>
    struct Nature {
        Word level, dies;
    };
    // Registers over the springs. The water is drawn in a lane that no springs need.
    template <class Draws>
    static Nature<std::uint64_t> draw_nature(const Draws& draws, std::uint64_t) {
        constexpr int n = lanes_in_one, last = n - 1;
        constexpr std::size_t water = 2 * n;  // the register that has this lane
        static_assert(springs <= 2 * (water + last) && springs > 2 * water);
        using Word = rddl::Lanes<std::uint64_t, n>;
        const handwritten::Draws<Word> many{Word{draws.step},
                                            {Word{draws.key[0]}, Word{draws.key[1]}}};
        std::uint64_t halves = 0, level = 0;
        for (std::size_t first = 0; first <= water; first += n) {
            Word site{mortality_site}, block = counting_from<n>(first);
            if (first == water) {
                site.set(last, 0);
                block.set(last, 0);
            }
            const auto numbers = many.two_integers(site, block);
            if (first == water) level = level_of(std::uint64_t{numbers.even[last]});
            const auto even = is_below(numbers.even, Word::load(&mortality.of[first]));
            const auto odd =
                is_below(numbers.odd, Word::load(&mortality.of[first + mortality.half]));
            halves |= std::uint64_t{even.bits} << first | std::uint64_t{odd.bits}
                                                              << (first + mortality.half);
        }
        return {level, joined_halves(halves)};
    }
    // Registers over environments.
    template <int n, class Draws>
    static Nature<rddl::Lanes<std::uint64_t, n>> draw_nature(
        const Draws& draws, const rddl::Lanes<std::uint64_t, n>& wanted) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        const Word zero{std::uint64_t{0}};
        return {level_of(draws.two_integers(zero, zero).even),
                draw_bits<springs>(draws, mortality_site, wanted, mortality)[0]};
    }

    // Which actions succeed: few springs have one, so the draws are made for one after the other.
    template <class Draws>
    static void keep_what_succeeds(Actions<rddl::Scalar>& actions, const Draws& draws) {
        for (std::size_t kind = 0; kind < kinds; ++kind)
            for_each_bit(actions.of[kind], [&](std::size_t spring) {
                if (integer_at(draws, kind + 1, spring) >= success[kind])
                    actions.of[kind] ^= std::uint64_t{1} << spring;
            });
    }
    // Each environment its own spring. No spring has two actions.
    template <int n, class Draws>
    static void keep_what_succeeds(Actions<rddl::Pack<n>>& actions, const Draws& draws) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        const Word zero{std::uint64_t{0}}, one{std::uint64_t{1}};
        Word left = actions.of[0] | actions.of[1] | actions.of[2], failed = zero;
        while (!all(is_zero(left))) {
            const Word rest = left & (left - one), bit = left ^ rest;
            const auto removes = !is_zero(bit & actions.of[1]);
            const auto translocates = !is_zero(bit & actions.of[2]);
            const Word kind =
                select(translocates, Word{std::uint64_t{2}}, select(removes, one, zero));
            const Word spring = bit_count(bit - one);
            const auto numbers = draws.two_integers(kind + one, spring >> 1);
            const Word number = if_zero(spring & one, numbers.even, numbers.odd);
            const Word limit = select(translocates, Word{success[2]},
                                      select(removes, Word{success[1]}, Word{success[0]}));
            failed = failed | select(is_below(number, limit), zero, bit);
            left = rest;
        }
        for (Word& of : actions.of) of = of ^ (of & failed);
    }

    // The springs that are connected to one with gambusia. Registers over the springs.
    static std::uint64_t reached(std::uint64_t gambusia, std::uint64_t level) {
        using Word = rddl::Lanes<std::uint64_t, lanes_in_one>;
        std::uint64_t bits = 0;
        for (std::size_t first = 0; first < springs; first += lanes_in_one) {
            const Word near = Word::load(red_finned_blue_eye::neighbours[level] + first);
            bits |= std::uint64_t{(!is_zero(near & Word{gambusia})).bits} << first;
        }
        return bits;
    }
    // Registers over environments: shifts by each distance that connected springs have.
    template <int n>
    static rddl::Lanes<std::uint64_t, n> reached(const rddl::Lanes<std::uint64_t, n>& gambusia,
                                                 const rddl::Lanes<std::uint64_t, n>& level) {
        rddl::Lanes<std::uint64_t, n> bits{std::uint64_t{0}};
        for (std::size_t k = 0; k < std::size(red_finned_blue_eye::distances); ++k) {
            const int distance = red_finned_blue_eye::distances[k];
            const auto open = entry_of_eight(red_finned_blue_eye::further[k], level);
            bits = bits | ((gambusia & open) << distance) | ((gambusia >> distance) & open);
        }
        return bits;
    }
    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& chosen, const Draws& draws) {
        using Word = typename L::Word;
        using Real = typename L::Real;
        const Word all{everywhere}, zero{std::uint64_t{0}};
        const Real value = 50 * real_of_count(bit_count(s.fish)) -
                           30 * real_of_count(bit_count(chosen.of[0])) -
                           select(is_zero(s.fish), Real{200.0}, Real{0.0});
        // Nothing waits in most environments.
        const Word waits = if_zero(s.wait, zero, s.wait - Word{std::uint64_t{1}});
        s.wait = if_zero(chosen.of[2], waits, Word{std::uint64_t{4}});

        Actions<L> succeeds = chosen;
        keep_what_succeeds(succeeds, draws);
        const Word emptied = succeeds.of[0] | succeeds.of[1];
        const Word others = all ^ (emptied | succeeds.of[2]);
        const auto nature = draw_nature(draws, others & (s.fish ^ all));
        const Word dies = others & (s.fish ^ all) & nature.dies;
        const Word left = others ^ dies;
        const Word invaded = left & reached(s.gambusia, nature.level);
        const Word same = left ^ invaded;
        s.fish = succeeds.of[2] | (s.fish & same);
        s.gambusia = invaded | (s.gambusia & same);
        return value;
    }

    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        const std::uint64_t fish = lane_of(s.fish, lane), gambusia = lane_of(s.gambusia, lane);
        std::int64_t values[springs + 1];
        for (std::size_t k = 0; k < springs; ++k)
            values[k] = (fish >> k & 1) != 0 ? 0 : (gambusia >> k & 1) != 0 ? 1 : 2;
        values[springs] = static_cast<std::int64_t>(lane_of(s.wait, lane));
        std::memcpy(record, values, sizeof values);
    }
};

}  // namespace handwritten
