// BinPacking_or 0: six bins, items of three kinds.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct BinPacking : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 40;
    static constexpr bool stochastic = true;
    static constexpr std::size_t bins = 6;
    static constexpr std::int64_t capacity = 40, first_size = 3;

    template <class L>
    struct State {
        typename L::Int total[bins], size;
    };
    template <class L>
    struct Actions {
        typename L::Bool place[bins];
    };

    static void start(State<rddl::Scalar>& state) {
        state = {};
        state.size = first_size;
    }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        for (auto& total : state.total) total = select(where, std::int64_t{0}, total);
        state.size = select(where, first_size, state.size);
    }

    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        for (std::size_t b = 0; b < bins; ++b) actions.place[b] = record[b] != std::byte{0};
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        std::uint64_t bits[bins]{};
        for (std::size_t lane = 0; lane < L::width; ++lane)
            for (std::size_t b = 0; b < bins; ++b)
                bits[b] |= std::to_integer<std::uint64_t>(records[lane * bins + b]) << lane;
        for (std::size_t b = 0; b < bins; ++b) actions.place[b] = L::Bool::of_bits(bits[b]);
    }

    static constexpr std::uint64_t before_second = threshold(bin_packing::probability[0]),
                                   before_third = threshold(bin_packing::probability[0] +
                                                            bin_packing::probability[1]);

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        using Int = typename L::Int;
        using Bool = typename L::Bool;
        const Int most{capacity - s.size};
        Int used{std::int64_t{0}};
        Bool places[bins], placed{false};
        for (std::size_t b = 0; b < bins; ++b) {
            used = used + select(s.total[b] > std::int64_t{0}, Int{1}, Int{0});
            places[b] = actions.place[b] && s.total[b] <= most;
            placed = placed || places[b];
        }
        if (!all(placed)) {
            Int least = s.total[0];
            for (const Int& total : s.total) least = select(total < least, total, least);
            for (std::size_t b = 0; b < bins; ++b)
                places[b] = places[b] || (!placed && s.total[b] == least);
        }
        for (std::size_t b = 0; b < bins; ++b)
            s.total[b] = s.total[b] + select(places[b], s.size, Int{0});
        const Word number = draws.two_integers(Word{std::uint64_t{0}}, Word{std::uint64_t{0}}).even;
        s.size = select(is_below(number, Word{before_second}), Int{bin_packing::size[0]},
                        select(is_below(number, Word{before_third}), Int{bin_packing::size[1]},
                               Int{bin_packing::size[2]}));
        return -rddl::to_real(used);
    }

    template <class L>
    static typename L::Bool broken(const State<L>& s) {
        using Int = typename L::Int;
        Int least = s.total[0], greatest = s.total[0];
        for (const Int& total : s.total) {
            least = select(total < least, total, least);
            greatest = select(total > greatest, total, greatest);
        }
        return greatest > capacity || least + s.size > capacity;
    }

    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        std::int64_t values[bins + 1];
        for (std::size_t b = 0; b < bins; ++b) values[b] = lane_of(s.total[b], lane);
        values[bins] = lane_of(s.size, lane);
        std::memcpy(record, values, sizeof values);
    }
};

}  // namespace handwritten
