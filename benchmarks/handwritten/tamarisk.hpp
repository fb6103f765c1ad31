// Tamarisk_MDP_ippc2014 10: 24 slots, two bits each; slots 3 r, 3 r + 1 and 3 r + 2 lie on reach r,
// and each reach flows into the next one.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct Tamarisk : RunsToTheHorizon {
    static constexpr int width = 8;
    static constexpr std::uint64_t horizon = 40;
    static constexpr bool stochastic = true;
    static constexpr std::size_t reaches = 8, each = 3, slots = reaches * each;
    static constexpr std::uint64_t first_slots = 0111111111;  // of each reach

    template <class L>
    struct State {
        typename L::Word tamarisk, native;
    };
    // The reaches as their first slots.
    template <class L>
    struct Actions {
        typename L::Word eradicate, restore;
    };

    static void start(State<rddl::Scalar>& state) {
        state = {tamarisk::tamarisk[0], tamarisk::native[0]};
    }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        state = {select(where, tamarisk::tamarisk[0], state.tamarisk),
                 select(where, tamarisk::native[0], state.native)};
    }

    // Eight bits as every third one.
    static constexpr auto spread_bits = [] {
        std::array<std::uint32_t, 1 << reaches> all{};
        for (std::uint32_t bits = 0; bits < all.size(); ++bits)
            for (std::size_t r = 0; r < reaches; ++r) all[bits] |= (bits >> r & 1) << each * r;
        return all;
    }();
    static std::uint64_t spread(const std::byte* bytes) {
        return spread_bits[bits_of_bytes<reaches>(bytes)];
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        load_words(actions.eradicate, records, 2 * reaches, spread);
        load_words(actions.restore, records, 2 * reaches,
                   [](const std::byte* record) { return spread(record + reaches); });
    }

    // The chance that a slot is invaded: that of no propagule is a power for those of its own reach
    // and of the reach above, times another for those of the reach below.
    static constexpr std::size_t most_below = 4;
    static constexpr auto chances = [] {
        std::array<std::uint64_t, 8 * most_below> all{};
        double near = 1;
        for (std::size_t above = 0; above < 2 * each; ++above, near *= 0.4) {
            double none = near;
            for (std::size_t below = 0; below < most_below; ++below, none *= 0.85)
                all[above * most_below + below] = threshold(0.1 + 0.9 * (1 - none));
        }
        return all;
    }();
    // The slots of a reach and the one above, and those of the one below.
    static constexpr auto slots_above = [](std::size_t slot) -> std::uint64_t {
        const std::size_t reach = slot / each;
        return reach == 0 ? 7 : std::uint64_t{077} << each * (reach - 1);
    };
    static constexpr auto slots_below = [](std::size_t slot) -> std::uint64_t {
        return std::uint64_t{7} << each * (slot / each + 1) & first_bits(slots);
    };

    struct Masks {
        std::array<std::uint64_t, 2 * Thresholds::half> above, below;
    };
    static constexpr Masks masks = [] {
        Masks all{};
        for (std::size_t k = 0; k < slots; ++k) {
            const std::size_t place = k / 2 + k % 2 * Thresholds::half;
            all.above[place] = slots_above(k);
            all.below[place] = slots_below(k);
        }
        return all;
    }();

    // The slots where tamarisks win, are not eradicated, live on, or come, if they may.
    template <class Word>
    struct Luck {
        Word wins, stays, lives, comes;
    };
    static constexpr std::uint64_t wins = threshold(0.8), stays = threshold(1 - 0.9),
                                   lives = threshold(1 - 0.05);

    template <class Draws>
    static Luck<std::uint64_t> luck(std::uint64_t tamarisk, const Draws& draws) {
        constexpr int n = lanes_in_one;
        using Word = rddl::Lanes<std::uint64_t, n>;
        const handwritten::Draws<Word> many{Word{draws.step},
                                            {Word{draws.key[0]}, Word{draws.key[1]}}};
        Luck<std::uint64_t> luck{};
        for (std::size_t first = 0; 2 * first < slots; first += n) {
            const auto numbers = many.two_integers(Word{std::uint64_t{4}}, counting_from<n>(first));
            const auto compare = [&](std::size_t at, const Word& number) {
                const Word above = bit_count(Word{tamarisk} & Word::load(&masks.above[at])),
                           below = bit_count(Word{tamarisk} & Word::load(&masks.below[at]));
                const Word chance =
                    gather_integers(chances.data(), rddl::ints_of((above << 2) + below));
                luck.wins |= std::uint64_t{is_below(number, Word{wins}).bits} << at;
                luck.stays |= std::uint64_t{is_below(number, Word{stays}).bits} << at;
                luck.lives |= std::uint64_t{is_below(number, Word{lives}).bits} << at;
                luck.comes |= std::uint64_t{is_below(number, chance).bits} << at;
            };
            compare(first, numbers.even);
            compare(first + Thresholds::half, numbers.odd);
        }
        return {joined_halves(luck.wins), joined_halves(luck.stays), joined_halves(luck.lives),
                joined_halves(luck.comes)};
    }
    template <int n, class Draws>
    static Luck<rddl::Lanes<std::uint64_t, n>> luck(const rddl::Lanes<std::uint64_t, n>& tamarisk,
                                                    const Draws& draws) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        const Word none{std::uint64_t{0}};
        Luck<Word> luck{none, none, none, none};
        Word chance = none;
        for (std::uint64_t k = 0; k < slots; k += 2) {
            const auto numbers = draws.two_integers(Word{std::uint64_t{4}}, Word{k / 2});
            const auto compare = [&](std::uint64_t slot, const Word& number) {
                if (slot % each == 0) {
                    const Word above = bit_count(tamarisk & slots_above(slot)),
                               below = bit_count(tamarisk & slots_below(slot));
                    chance = gather_integers(chances.data(), rddl::ints_of((above << 2) + below));
                }
                const auto bit = [&](const Word& limit) {
                    return select(is_below(number, limit), Word{std::uint64_t{1} << slot}, none);
                };
                luck.wins = luck.wins | bit(Word{wins});
                luck.stays = luck.stays | bit(Word{stays});
                luck.lives = luck.lives | bit(Word{lives});
                luck.comes = luck.comes | bit(chance);
            };
            compare(k, numbers.even);
            compare(k + 1, numbers.odd);
        }
        return luck;
    }

    static constexpr auto native_wins = Thresholds::equal(0.2),
                          native_comes = Thresholds::equal(0.1),
                          native_lives = Thresholds::equal(1 - 0.05),
                          restored = Thresholds::equal(0.9);

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        const auto of_reach = [](const Word& first) {
            return first | first << 1 | first << 2;
        };
        const Word all{first_bits(slots)};
        const Word tamarisk = s.tamarisk, native = s.native;
        const Word both = tamarisk & native, taken = tamarisk | native, empty = all ^ taken;
        const Word alone = tamarisk ^ both, native_alone = native ^ both;
        const Word eradicate = of_reach(actions.eradicate), restore = of_reach(actions.restore);
        const Word first = tamarisk | tamarisk >> 1 | tamarisk >> 2;
        const auto value = -5.0 * real_of_count(bit_count(first & first_slots)) -
                           0.5 * real_of_count(bit_count(tamarisk)) -
                           0.25 * real_of_count(bit_count(empty)) -
                           0.49 * real_of_count(bit_count(actions.eradicate)) -
                           0.9 * real_of_count(bit_count(actions.restore)) -
                           0.4 * real_of_count(bit_count(restore & empty));

        const auto [wins, stays, lives, comes] = luck(tamarisk, draws);
        const auto [n_wins, n_comes, n_lives, succeeds] =
            draw_bits<slots>(draws, 0, all, native_wins, native_comes, native_lives, restored);
        const Word invaded = empty & comes;
        s.tamarisk = (both & wins) | (alone & ((eradicate & stays) | (lives & (all ^ eradicate)))) |
                     (invaded ^ (invaded & eradicate));
        s.native = (both & n_wins) | (native_alone & (restore | n_lives)) |
                   (empty & ((restore & succeeds) | (n_comes & (all ^ restore))));
        return value;
    }

    template <class L>
    static void store(const State<L>& state, std::int64_t lane, std::byte* record) {
        store_bits_as_bytes<slots>(lane_of(state.tamarisk, lane), record);
        store_bits_as_bytes<slots>(lane_of(state.native, lane), record + slots);
    }
};

}  // namespace handwritten
