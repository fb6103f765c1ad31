// CooperativeRecon_ippc2018 11: two rovers on a grid of 36 cells, each with tools of its own,
// examine eight objects. A tool is used by its rover alone, on one object.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct CooperativeRecon : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 60;
    static constexpr bool stochastic = true;
    static constexpr std::size_t rovers = 2, tools = 5, objects = 8, kinds = 3;
    static constexpr std::uint64_t size = 6;  // cell = x * size + y
    static constexpr std::uint64_t all_tools = first_bits(tools), all_objects = first_bits(objects);

    // The bits of the record's bools: of each tool whether it is damaged, then of each object,
    // eight bits for each fact; and the cells of the rovers.
    enum Fact {
        water_checked,
        water_detected,
        life_checked,
        life_checked_2,
        life_detected,
        picture_taken
    };
    // The number of the first bit that is set.
    template <class Word>
    static Word first_bit(const Word& bits) {
        return bit_count((bits ^ (bits - std::uint64_t{1})) >> 1);
    }
    static constexpr int place_of(int fact) { return static_cast<int>(tools + objects * fact); }
    static constexpr std::size_t bits = tools + 6 * objects;
    template <class L>
    struct State {
        typename L::Word bits, cell[rovers];
    };
    // The moves of both rovers: up, down, left, right. The objects that each rover applies its
    // detector of water to, its detector of life and its camera. Rovers that are supported; tools
    // that are repaired.
    template <class L>
    struct Actions {
        typename L::Word moves, use[rovers], supported, repaired;
    };

    static void start(State<rddl::Scalar>& state) {
        state = {0, {cooperative_recon::cells[0], cooperative_recon::cells[1]}};
    }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        state.bits = select(where, std::uint64_t{0}, state.bits);
        for (std::size_t r = 0; r < rovers; ++r)
            state.cell[r] = select(where, cooperative_recon::cells[r], state.cell[r]);
    }

    static constexpr std::size_t record_size = 102;
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        typename L::Word first, second;
        load_words(first, records, record_size, bits_of_bytes<64>);
        load_words(second, records, record_size, [](const std::byte* record) {
            return bits_of_bytes<record_size - 64>(record + 64);
        });
        const auto part = [](const auto& word, int begin, std::size_t count) {
            return word >> begin & first_bits(count);
        };
        actions.moves = part(first, 0, 8);
        actions.use[0] = part(first, 8, 2 * objects);
        actions.use[1] = part(second, 0, kinds * objects);
        actions.supported = part(second, 24, 2) | part(second, 26, 2);
        actions.repaired = part(second, 28, 2) | part(second, 35, 3) << 2;
    }

    static constexpr std::size_t tools_of_first = 2;
    static constexpr auto damage = [] {
        std::array<std::uint64_t, size * size> all{};
        for (std::size_t cell = 0; cell < all.size(); ++cell)
            all[cell] = threshold(cooperative_recon::damage[cell]);
        return all;
    }();
    // Tools that get damaged. One environment: registers over pairs of tools, of which the first
    // are those of the first rover.
    static std::uint64_t damaged(const State<rddl::Scalar>& s, std::uint64_t wanted,
                                 const Draws<std::uint64_t>& draws) {
        if (wanted == 0) return 0;
        constexpr int n = lanes_in_one;
        using Word = rddl::Lanes<std::uint64_t, n>;
        const Draws<Word> many{Word{draws.step}, {Word{draws.key[0]}, Word{draws.key[1]}}};
        const auto numbers = many.two_integers(Word{std::uint64_t{0}}, counting_from<n>(0));
        const Word limit = select(rddl::Mask<n>::of_bits(first_bits(tools_of_first / 2)),
                                  Word{damage[s.cell[0]]}, Word{damage[s.cell[1]]});
        const std::uint64_t even = is_below(numbers.even, limit).bits,
                            odd = is_below(numbers.odd, limit).bits;
        return wanted & (to_even_bits(even) | to_even_bits(odd) << 1);
    }
    template <int n>
    static rddl::Lanes<std::uint64_t, n> damaged(
        const State<rddl::Pack<n>>& s, const rddl::Lanes<std::uint64_t, n>& wanted,
        const Draws<rddl::Lanes<std::uint64_t, n>>& draws) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        const Word none{std::uint64_t{0}};
        Word bits = none;
        for (std::uint64_t t = 0; t < tools; t += 2) {
            if (all(is_zero(wanted & (std::uint64_t{3} << t)))) continue;
            const Word& cell = s.cell[t < tools_of_first ? 0 : 1];
            const Word limit = gather_integers(damage.data(), rddl::ints_of(cell));
            const auto numbers = draws.two_integers(none, Word{t / 2});
            bits = bits | select(is_below(numbers.even, limit), Word{std::uint64_t{1} << t}, none) |
                   select(is_below(numbers.odd, limit), Word{std::uint64_t{2} << t}, none);
        }
        return bits & wanted;
    }

    // A tool that finds what it looks for, by the number 2 * has support + is damaged.
    static constexpr std::uint64_t chances[] = {threshold(0.5), threshold(0.25), threshold(0.8),
                                                threshold(0.4)};
    static std::uint64_t chance(std::uint64_t number) { return chances[number]; }
    template <int n>
    static rddl::Lanes<std::uint64_t, n> chance(const rddl::Lanes<std::uint64_t, n>& number) {
        return gather_integers(chances, rddl::ints_of(number));
    }
    // The bit of a rover's test for water, or eight further for life, if it succeeds.
    template <class L, class Draws>
    static typename L::Word successful(const State<L>& s, const Actions<L>& actions,
                                       std::size_t rover, const typename L::Word& test,
                                       const Draws& draws) {
        using Word = typename L::Word;
        const Word none{std::uint64_t{0}}, one{std::uint64_t{1}};
        const int r = static_cast<int>(rover);
        const Word is_damaged =
            if_zero(test >> 8, s.bits >> 2 * r & one, s.bits >> (2 * r + 1) & one);
        const Word support = actions.supported >> r & one;
        const Word object = first_bit(test) & std::uint64_t{7};
        const Word site = if_zero(test >> 8, Word{std::uint64_t{5}}, one);
        const auto numbers = draws.two_integers(site, object >> 1);
        const Word number = if_zero(object & one, numbers.even, numbers.odd);
        return select(is_below(number, chance((support << 1) + is_damaged)), test, none);
    }

    // By the object that is photographed, the last entry for none, and whether the camera is
    // damaged.
    static double reward(std::uint64_t place) { return cooperative_recon::rewards[place]; }
    template <int n>
    static rddl::Lanes<double, n> reward(const rddl::Lanes<std::uint64_t, n>& place) {
        return gather(cooperative_recon::rewards, rddl::ints_of(place));
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        // All that is true stays so, except that tools are repaired.
        Word next = s.bits ^ (s.bits & actions.repaired);
        next = next | damaged(s, ((s.bits | actions.repaired) & all_tools) ^ all_tools, draws);

        const Word all_uses = actions.use[0] | actions.use[1];
        auto result = typename L::Real{0.0};
        if (!all(is_zero(all_uses))) {
            const Word picture = actions.use[1] >> 16, camera = s.bits >> 4 & std::uint64_t{1};
            result = reward(first_bit(picture | (all_objects + 1)) + (camera << 4));
            const auto fact = [&](Fact which) {
                return s.bits >> place_of(which) & all_objects;
            };
            const auto add = [&](Fact which, const Word& objects) {
                next = next | (objects & all_objects) << place_of(which);
            };
            const Word life = all_uses >> 8 & fact(life_checked);
            const Word no_water = fact(water_detected) ^ all_objects;
            const Word settled =
                fact(water_checked) | (fact(life_checked_2) | fact(life_detected) | no_water) << 8;
            add(water_checked, all_uses);
            add(life_checked, all_uses >> 8);
            add(life_checked_2, life);
            add(picture_taken, picture);
            for (std::size_t r = 0; r < rovers; ++r) {
                const Word tests = actions.use[r] & first_bits(2 * objects);
                const Word open = tests ^ (tests & settled);
                if (all(is_zero(open))) continue;
                const Word found = successful(s, actions, r, open, draws);
                add(water_detected, found);
                add(life_detected, found >> 8);
            }
        }
        s.bits = next;
        move(s, actions.moves);
        return result;
    }

    // Rovers stay on the grid.
    template <class L>
    static void move(State<L>& s, const typename L::Word& moves) {
        for (int r = 0; r < static_cast<int>(rovers); ++r) {
            const auto is = [&](int direction) {
                return moves >> (2 * direction + r) & std::uint64_t{1};
            };
            const auto right = is(3) - is(2);
            s.cell[r] = s.cell[r] + (is(0) - is(1)) + (right << 2) + (right << 1);
        }
    }

    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        store_bits_as_bytes<bits>(lane_of(s.bits, lane), record);
        for (std::size_t r = 0; r < rovers; ++r) {
            std::byte* const cells = record + bits + r * size * size;
            std::fill_n(cells, size * size, std::byte{0});
            cells[lane_of(s.cell[r], lane)] = std::byte{1};
        }
    }
};

}  // namespace handwritten
