// Logistics_rddlsim 0: four trucks, four cities and four boxes.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

// Legal actions keep the invariants: a truck is in one city and docks only there, and a box is in
// one truck at most.
struct Logistics : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 50;
    static constexpr bool stochastic = true;
    static constexpr int count = 4;  // of trucks, of cities and of boxes
    static constexpr std::size_t pairs = count * count, record_size = 5 * pairs;
    // The bits of a table of pairs: its first row, its first column and all.
    static constexpr std::uint64_t row = 0xf, column = 0x1111, table = 0xffff;

    // Tables of 16 bits, one after the other: truckAt, atDepot, boxInTruck and boxInCity.
    template <class L>
    struct State {
        typename L::Word tables;
    };
    // drive, doDockAt, unload and load.
    template <class L>
    struct Actions {
        typename L::Word tables, undock;
    };

    static void start(State<rddl::Scalar>& state) { state.tables = logistics::start; }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        state.tables = select(where, logistics::start, state.tables);
    }

    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        load_words(actions.tables, records, record_size, bits_of_bytes<64>);
        load_words(actions.undock, records + 64, record_size, bits_of_bytes<record_size - 64>);
    }

    // The first row, in all rows.
    template <class Word>
    static Word in_all_rows(Word bits) {
        bits = bits | bits << count;
        return bits | bits << 2 * count;
    }
    // The rows in which a bit is set.
    template <class Word>
    static Word rows_of(const Word& bits) {
        const Word pairs_of_bits = bits | bits >> 1;
        return rows_from((pairs_of_bits | pairs_of_bits >> 2) & column);
    }
    // The rows whose first bit is set.
    template <class Word>
    static Word rows_from(const Word& firsts) {
        return (firsts << count) - firsts;
    }
    template <class Word>
    static Word without(const Word& a, const Word& b) {
        return a ^ (a & b);
    }
    // Columns in which a bit, two and four bits are set.
    template <class Word>
    struct Columns {
        Word one, two, four;
    };
    template <class Word>
    static Columns<Word> count_in_columns(const Word& bits) {
        const Word both = bits & bits >> count, either = bits | bits >> count;
        return {(either | either >> 2 * count) & row,
                (both | both >> 2 * count | (either & either >> 2 * count)) & row,
                both & both >> 2 * count & row};
    }
    // Two tables, one after the other, each transposed.
    template <class Word>
    static Word transposed(Word bits) {
        const auto swap = [&](int distance, std::uint64_t which) {
            const Word changes = (bits ^ bits >> distance) & which;
            bits = bits ^ changes ^ changes << distance;
        };
        swap(count - 1, 0x0a0a0a0a);
        swap(2 * (count - 1), 0x00cc00cc);
        return bits;
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        const Word at = s.tables & table, docked = s.tables >> 16 & table,
                   inside = s.tables >> 32 & table, in_city = s.tables >> 48;
        const Word drive = actions.tables & table, dock = actions.tables >> 16 & table;
        const Word unload_load = transposed(actions.tables >> 32);
        const Word unload = unload_load & inside, load = unload_load >> 16;

        // A crowd of two or three lets every second truck in or out, one of four none.
        const auto crowd = count_in_columns(at);
        const Word crowded = in_all_rows(crowd.two), full = in_all_rows(crowd.four);
        const Word maybe_there = without(drive & crowded, full);
        const Word stays = without(docked, actions.undock);
        const auto trying = count_in_columns(stays | dock), there = count_in_columns(docked);
        const Word busy = in_all_rows(trying.two | there.two | (trying.one & there.one));
        const Word blocked = in_all_rows(trying.two & there.two);
        const Word undocks = docked & actions.undock, docks = without(dock, docked);
        const Word maybe_docks = without((undocks | docks) & busy, blocked);

        const Word lucky = draw(maybe_there | maybe_docks << 16 | unload << 32 | load << 48, draws);

        const Word there_now = without(drive, crowded) | (lucky & table);
        const Word next_at = there_now | without(at, rows_of(there_now));
        const Word change = lucky >> 16 & table;
        const Word next_docked = stays | (undocks & blocked) |
                                 without(undocks & maybe_docks, change) | without(docks, busy) |
                                 (docks & change);
        const Word carried = rows_of(inside);
        const Word free_in_city = without(in_city, carried);
        const Word next_inside = without(inside, lucky >> 32 & table) | lucky >> 48;
        s.tables = next_at | next_docked << 16 | next_inside << 32 |
                   (free_in_city | cities_of(inside, next_at)) << 48;
        return real_of_count(bit_count(free_in_city & logistics::destinations));
    }

    // The cities of the boxes in trucks.
    template <class Word>
    static Word cities_of(const Word& inside, const Word& at) {
        Word cities{std::uint64_t{0}};
        if (all(is_zero(inside))) return cities;
        for (int truck = 0; truck < count; ++truck)
            cities = cities |
                     (rows_from(inside >> truck & column) & in_all_rows(at >> truck * count & row));
        return cities;
    }
    static bool all(bool condition) { return condition; }
    template <int n>
    static bool all(const rddl::Mask<n>& mask) {
        return rddl::all(mask);
    }

    // The wanted bits that are drawn to be true: for drives, docks, unloading and loading. An
    // action wants three at most.
    static constexpr std::uint64_t sites[] = {8, 2, 0, 1};
    static constexpr std::uint64_t crowd_limit = threshold(0.5),
                                   load_limit = threshold(logistics::load_probability);
    template <class Draws>
    static std::uint64_t draw(std::uint64_t wanted, const Draws& draws) {
        std::uint64_t lucky = 0;
        for_each_bit(wanted, [&](std::size_t bit) {
            const std::uint64_t number = integer_at(draws, sites[bit / pairs], bit % pairs);
            const bool is_true = number < (bit < 2 * pairs ? crowd_limit : load_limit);
            lucky |= std::uint64_t{is_true} << bit;
        });
        return lucky;
    }
    // Each environment its first bit, then its second one and so on.
    template <int n, class Draws>
    static rddl::Lanes<std::uint64_t, n> draw(rddl::Lanes<std::uint64_t, n> wanted,
                                              const Draws& draws) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        const Word none{std::uint64_t{0}};
        Word lucky = none;
        while (!all(is_zero(wanted))) {
            const Word bit = wanted & (none - wanted);
            const Word place = bit_count(bit - Word{std::uint64_t{1}});
            const Word site = gather_integers(sites, rddl::ints_of(place >> 4));
            const auto numbers = draws.two_integers(site, (place & std::uint64_t{15}) >> 1);
            const Word number = if_zero(place & std::uint64_t{1}, numbers.even, numbers.odd);
            const Word limit = if_zero(place >> 5, Word{crowd_limit}, Word{load_limit});
            lucky = lucky | select(is_below(number, limit), bit, none);
            wanted = wanted ^ bit;
        }
        return lucky;
    }

    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        store_bits_as_bytes<4 * pairs>(lane_of(s.tables, lane), record);
    }
};

}  // namespace handwritten
