// GameOfLife_MDP_ippc2011 10: 30 cells, a bit each; the neighbours are counted for all cells at
// once, by adding words bit by bit.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct GameOfLife : RunsToTheHorizon {
    static constexpr int width = 8;
    static constexpr std::uint64_t horizon = 40;
    static constexpr bool stochastic = true;
    static constexpr int columns = 10, rows = 3;  // cell = column * rows + row
    static constexpr std::size_t cells = std::size(game_of_life::noise);
    static constexpr std::uint64_t everywhere = first_bits(cells);
    static constexpr std::uint64_t top_row = 01111111111, bottom_row = top_row << 2;

    template <class L>
    struct State {
        typename L::Word alive;
    };
    template <class L>
    struct Actions {
        typename L::Word set;
    };

    static void start(State<rddl::Scalar>& state) { state.alive = game_of_life::alive[0]; }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        state.alive = select(where, game_of_life::alive[0], state.alive);
    }

    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        load_words(actions.set, records, cells, bits_of_bytes<cells>);
    }

    // A number of two bits for each cell.
    template <class Word>
    struct Counts {
        Word ones, twos;
    };
    template <class Word>
    static Word at_least_two(const Word& a, const Word& b, const Word& c) {
        return (a & b) | ((a ^ b) & c);
    }

    // Whether a cell has two or three living neighbours, and whether it has three.
    template <class Word>
    struct Neighbours {
        Word two_or_three, three;
    };
    template <class Word>
    static Neighbours<Word> count(const Word& alive) {
        const Word above = (alive & (everywhere & ~bottom_row)) << 1,
                   below = (alive & (everywhere & ~top_row)) >> 1;
        const Counts<Word> beside{above ^ below, above & below};
        const Counts<Word> column{beside.ones ^ alive, at_least_two(above, below, alive)};
        const Counts<Word> left{column.ones << rows & everywhere, column.twos << rows & everywhere};
        const Counts<Word> right{column.ones >> rows, column.twos >> rows};
        const Word ones = beside.ones ^ left.ones ^ right.ones;
        const Word carry = at_least_two(beside.ones, left.ones, right.ones);
        const Word odd = beside.twos ^ left.twos ^ right.twos ^ carry;
        const Word two_pairs = (beside.twos & left.twos) | (right.twos & carry) |
                               ((beside.twos | left.twos) & (right.twos | carry));
        const Word one_pair = odd ^ (odd & two_pairs);
        return {one_pair, one_pair & ones};
    }

    static constexpr Thresholds noise = Thresholds::of_chances(game_of_life::noise);
    static constexpr Thresholds otherwise = [] {
        double chances[cells];
        for (std::size_t k = 0; k < cells; ++k) chances[k] = 1.0 - game_of_life::noise[k];
        return Thresholds::of_chances(chances);
    }();

    template <class L, class Draws>
    static typename L::Real step(State<L>& state, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        const Word alive = state.alive;
        const auto [two_or_three, three] = count(alive);
        const Word lives = (alive & two_or_three) | three | actions.set;
        const auto [unlikely, likely] =
            draw_bits<cells>(draws, 0, Word{everywhere}, noise, otherwise);
        state.alive = unlikely ^ ((unlikely ^ likely) & lives);
        return real_of_count(bit_count(alive)) - real_of_count(bit_count(actions.set));
    }

    template <class L>
    static void store(const State<L>& state, std::int64_t lane, std::byte* record) {
        store_bits_as_bytes<cells>(lane_of(state.alive, lane), record);
    }
};

}  // namespace handwritten
