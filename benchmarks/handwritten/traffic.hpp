// Traffic_MDP_ippc2014 10, and others with its streets (traffic_ctm.hpp): two pairs of streets of
// 36 cells each, a word for each pair; cars flow two bits further. Four intersections, of which the
// lights are a word for each of their two bits.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

template <class Tables>
struct CrossingStreets : RunsToTheHorizon {
    static constexpr int width = 8;
    static constexpr std::uint64_t horizon = 40;
    static constexpr bool stochastic = true;
    static constexpr std::size_t intersections = 4, cells = 36;
    static constexpr std::uint64_t lights = first_bits(intersections),
                                   everywhere = first_bits(cells);
    static constexpr int flow = 2;
    static constexpr std::uint64_t inputs = 3;

    template <class L>
    struct State {
        typename L::Word first_light, second_light;
        std::array<typename L::Word, 2> cars;
    };
    template <class L>
    struct Actions {
        typename L::Word advance;
    };

    static void start(State<rddl::Scalar>& state) {
        state = {0, 0, {Tables::occupied[0], Tables::occupied[1]}};
    }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        const std::uint64_t none = 0;
        state = {select(where, none, state.first_light),
                 select(where, none, state.second_light),
                 {select(where, Tables::occupied[0], state.cars[0]),
                  select(where, Tables::occupied[1], state.cars[1])}};
    }

    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        load_words(actions.advance, records, intersections, bits_of_bytes<intersections>);
    }

    // The cells that cars may leave, by the lights: all but those before a red one.
    static constexpr auto gates = [] {
        std::array<std::array<std::uint64_t, 256>, 2> all{};
        for (std::size_t half = 0; half < 2; ++half)
            for (std::size_t colours = 0; colours < 256; ++colours) {
                std::uint64_t& open = all[half][colours];
                open = everywhere;
                for (std::size_t i = 0; i < intersections; ++i) {
                    const bool first = colours >> i & 1, second = colours >> (i + 4) & 1;
                    if (!(second && !first)) open &= ~Tables::north_south[i][half];
                    if (!(first && !second)) open &= ~Tables::east_west[i][half];
                }
            }
        return all;
    }();
    static std::uint64_t gate(std::size_t half, std::uint64_t colours) {
        return gates[half][colours];
    }
    template <int n>
    static rddl::Lanes<std::uint64_t, n> gate(std::size_t half,
                                              const rddl::Lanes<std::uint64_t, n>& colours) {
        return gather_integers(gates[half].data(), rddl::ints_of(colours));
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& state, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        const Word colours = state.first_light | state.second_light << int{intersections};
        const Word turns =
            actions.advance | ((state.first_light ^ state.second_light) ^ Word{lights});
        const Word first = state.first_light, second = state.second_light;
        state.first_light = first ^ ((first ^ second) & turns);
        state.second_light = second ^ ((second ^ first ^ lights) & turns);

        Word queued{std::uint64_t{0}};
        for (std::size_t half = 0; half < 2; ++half) {
            const Word cars = state.cars[half];
            const Word empty = cars ^ Word { everywhere };
            queued = queued + bit_count(cars & cars << flow);
            const Word ready = cars & gate(half, colours);
            const Word leaves = (ready & empty >> flow) | (cars & Tables::exits[half]);
            const Word arrives = empty & ready << flow;
            const auto numbers =
                draws.two_integers(Word{std::uint64_t{0}}, Word{std::uint64_t{half * cells / 2}});
            state.cars[half] =
                (cars ^ leaves) | arrives |
                (empty & (enters(numbers.even, half, 0) | enters(numbers.odd, half, 1)));
        }
        return -real_of_count(queued);
    }

    static constexpr std::uint64_t rates[2][2] = {
        {threshold(Tables::rates[0][0]), threshold(Tables::rates[0][1])},
        {threshold(Tables::rates[1][0]), threshold(Tables::rates[1][1])}};
    static std::uint64_t enters(std::uint64_t number, std::size_t half, std::size_t cell) {
        return std::uint64_t{number < rates[half][cell]} << cell;
    }
    template <int n>
    static rddl::Lanes<std::uint64_t, n> enters(const rddl::Lanes<std::uint64_t, n>& number,
                                                std::size_t half, std::size_t cell) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        return select(is_below(number, Word{rates[half][cell]}), Word{std::uint64_t{1} << cell},
                      Word{std::uint64_t{0}});
    }

    template <class L>
    static void store(const State<L>& state, std::int64_t lane, std::byte* record) {
        store_bits_as_bytes<intersections>(lane_of(state.first_light, lane), record);
        store_bits_as_bytes<intersections>(lane_of(state.second_light, lane),
                                           record + intersections);
        record += 2 * intersections;
        store_bits_as_bytes<cells>(lane_of(state.cars[0], lane), record);
        store_bits_as_bytes<cells>(lane_of(state.cars[1], lane), record + cells);
    }
};

struct TrafficTables {
    static constexpr const auto& occupied = traffic::occupied;
    static constexpr const auto& exits = traffic::exits;
    static constexpr const auto& north_south = traffic::north_south;
    static constexpr const auto& east_west = traffic::east_west;
    static constexpr const auto& rates = traffic::rates;
};
struct Traffic : CrossingStreets<TrafficTables> {};

}  // namespace handwritten
