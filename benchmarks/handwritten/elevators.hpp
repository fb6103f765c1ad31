// Elevators_MDP_ippc2014 10: one elevator, six floors; the waiting of all floors are words, and so
// is the floor of the elevator.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct Elevators : RunsToTheHorizon {
    static constexpr int width = 8;
    static constexpr std::uint64_t horizon = 40;
    static constexpr bool stochastic = true;
    static constexpr std::size_t floors = std::size(elevators::arrive);
    static constexpr std::uint64_t bottom = 1, top = bottom << (floors - 1),
                                   everywhere = first_bits(floors);

    template <class L>
    struct State {
        typename L::Word waiting_up, waiting_down, floor;
        typename L::Word rider_up, rider_down, upwards, closed;  // all bits are the same
    };
    template <class L>
    struct Actions {
        FourBools<typename L::Word> wanted;  // move, open going up, open going down, close
    };

    static constexpr std::uint64_t yes = ~std::uint64_t{0};
    static void start(State<rddl::Scalar>& state) { state = {0, 0, bottom, 0, 0, yes, yes}; }
    template <class L>
    static void start(State<L>& s, typename L::Bool where) {
        const auto become = [&](typename L::Word& word, std::uint64_t value) {
            word = select(where, value, word);
        };
        for (auto* const word : {&s.waiting_up, &s.waiting_down, &s.rider_up, &s.rider_down})
            become(*word, 0);
        become(s.floor, bottom);
        become(s.upwards, yes);
        become(s.closed, yes);
    }

    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        load_four_bools(actions.wanted, records);
    }

    static constexpr Thresholds arrivals = Thresholds::of_chances(elevators::arrive);

    template <class Word>
    struct Arrivals {
        Word up, down;
    };
    // Lanes: three counter values of the site of those who go up, and of those who go down.
    template <class Draws>
    static Arrivals<std::uint64_t> arriving(const Draws& draws, std::uint64_t, std::uint64_t) {
        constexpr int n = lanes_in_one, down = n / 2;
        using Word = rddl::Lanes<std::uint64_t, n>;
        static constexpr std::uint64_t sites[n] = {1, 1, 1, 1, 0, 0, 0, 0},
                                       blocks[n] = {0, 1, 2, 0, 0, 1, 2, 0};
        static constexpr auto limits = [] {
            std::array<std::array<std::uint64_t, n>, 2> all{};
            for (std::size_t k = 0; k < floors; ++k)
                all[k % 2][k / 2] = all[k % 2][k / 2 + down] = arrivals[k];
            return all;
        }();
        const handwritten::Draws<Word> many{Word{draws.step},
                                            {Word{draws.key[0]}, Word{draws.key[1]}}};
        const auto numbers = many.two_integers(Word::load(sites), Word::load(blocks));
        const std::uint64_t even = is_below(numbers.even, Word::load(limits[0].data())).bits,
                            odd = is_below(numbers.odd, Word::load(limits[1].data())).bits;
        const std::uint64_t both = joined_halves(even | odd << 32);
        return {both & everywhere, both >> 2 * down & everywhere};
    }
    template <int n, class Draws>
    static Arrivals<rddl::Lanes<std::uint64_t, n>> arriving(
        const Draws& draws, const rddl::Lanes<std::uint64_t, n>& up,
        const rddl::Lanes<std::uint64_t, n>& down) {
        return {draw_bits<floors>(draws, 1, up, arrivals)[0],
                draw_bits<floors>(draws, 0, down, arrivals)[0]};
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        const auto& [move, open_up, open_down, close] = actions.wanted;
        const Word downwards = s.upwards ^ yes, open = s.closed ^ yes;
        const auto reward =
            -real_of_count(bit_count(s.waiting_up) + bit_count(s.waiting_down)) -
            0.75 * real_of_count(bit_count(((s.rider_up & s.upwards) & std::uint64_t{1}) |
                                           ((s.rider_down & downwards) & std::uint64_t{2}))) -
            3.0 * real_of_count(bit_count(((s.rider_up & downwards) & std::uint64_t{1}) |
                                          ((s.rider_down & s.upwards) & std::uint64_t{2})));

        const Word served_up = s.floor & s.upwards & open, served_down = s.floor & downwards & open;
        const Word left_up = s.waiting_up ^ (s.waiting_up & served_up);
        const Word left_down = s.waiting_down ^ (s.waiting_down & served_down);
        const auto more = arriving(draws, left_up ^ Word{everywhere}, left_down ^ Word{everywhere});

        const Word none{std::uint64_t{0}}, all_bits{yes};
        const Word stays_up = if_zero(s.floor & top, all_bits, none);
        const Word stays_down = if_zero(s.floor & bottom, all_bits, none);
        const Word enters_up = if_zero(served_up & s.waiting_up, none, all_bits);
        const Word enters_down = if_zero(served_down & s.waiting_down, none, all_bits);
        const Word moves = s.closed & move;
        const Word above = (s.floor << 1 & everywhere) | (s.floor & top);
        const Word below = s.floor >> 1 | (s.floor & bottom);
        const Word target = (above & s.upwards) | (below & downwards);
        s = {left_up | more.up,
             left_down | more.down,
             s.floor ^ ((s.floor ^ target) & moves),
             (s.rider_up & stays_up) | (enters_up & (s.rider_up ^ yes)),
             (s.rider_down & stays_down) | (enters_down & (s.rider_down ^ yes)),
             open_up | (s.upwards & (open_down ^ yes)),
             (s.closed & ((open_up | open_down) ^ yes)) | close};
        return reward;
    }

    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        store_bits_as_bytes<floors>(lane_of(s.waiting_up, lane), record);
        store_bits_as_bytes<floors>(lane_of(s.waiting_down, lane), record + floors);
        record += 2 * floors;
        for (const auto& word : {s.rider_up, s.rider_down, s.upwards, s.closed})
            store_bits_as_bytes<1>(lane_of(word, lane), record++);
        store_bits_as_bytes<floors>(lane_of(s.floor, lane), record);
    }
};

}  // namespace handwritten
