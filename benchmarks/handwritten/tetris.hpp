// Tetris_arcade 0: a board of four columns and six rows, a bit for each cell, row after row. Relies
// on legal actions: each step places the shape in one column.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct Tetris {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 100;
    static constexpr bool stochastic = true;
    static constexpr std::size_t columns = 4, rows = 6, cells = columns * rows, shapes = 5,
                                 rotations = 4;
    static constexpr std::uint64_t board = first_bits(cells), row = first_bits(columns),
                                   row_starts = board / row, last_row = rows - 1;
    static constexpr double scores[8] = {0, 40, 100, 300, 1200, 1200, 1200};

    template <class L>
    struct State {
        typename L::Word filled, shape, over;
    };
    template <class L>
    struct Actions {
        typename L::Word rotation, column;
    };

    static void start(State<rddl::Scalar>& s) { s = {0, tetris::shape, 0}; }
    template <class L>
    static void start(State<L>& s, typename L::Bool where) {
        const std::uint64_t none = 0, shape = tetris::shape;
        s = {select(where, none, s.filled), select(where, shape, s.shape),
             select(where, none, s.over)};
    }

    struct ActionRecord {
        std::uint64_t rotation;
        std::byte places[columns];
    };
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        const auto read = [](const std::byte* record) {
            ActionRecord values;
            std::memcpy(&values, record, sizeof values);
            return values;
        };
        load_words(actions.rotation, records, sizeof(ActionRecord),
                   [&](const std::byte* record) { return read(record).rotation; });
        load_words(actions.column, records, sizeof(ActionRecord), [&](const std::byte* record) {
            std::uint32_t places;  // a byte is 1
            std::memcpy(&places, read(record).places, sizeof places);
            return static_cast<std::uint64_t>(__builtin_ctz(places) / 8);
        });
    }

    // The cells that a shape fills in the lowest rows, by shape, rotation and column; those beyond
    // the last column are nowhere.
    static std::uint64_t placed(std::uint64_t index) { return tetris::placed[index]; }
    template <int n>
    static auto placed(const rddl::Lanes<std::uint64_t, n>& index) {
        return gather_integers(tetris::placed, rddl::ints_of(index));
    }
    static double score(std::uint64_t cleared) { return scores[cleared]; }
    template <int n>
    static auto score(const rddl::Lanes<std::uint64_t, n>& cleared) {
        return gather(scores, rddl::ints_of(cleared));
    }

    // The first shape that is drawn, or the first of all.
    static constexpr Thresholds chances = Thresholds::equal(1.0 / shapes);
    template <class Word>
    static Word first_shape(const Word& drawn) {
        const Word one{std::uint64_t{1}}, found = if_zero(drawn, one, drawn);
        return bit_count((found & (Word{std::uint64_t{0}} - found)) - one);
    }

    // Rows above those that are full move down.
    template <class Word>
    static Word without(const Word& filled, const Word& full) {
        Word left = filled;
        for (std::size_t k = rows; k-- > 0;) {
            const Word below = left & first_bits(columns * k);
            const Word moved = below | (((left >> static_cast<int>(columns)) | below) ^ below) &
                                           ~first_bits(columns * k);
            left = if_zero(full & std::uint64_t{1} << columns * k, left, moved);
        }
        return left;
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        const Word zero{std::uint64_t{0}}, every{board};
        const Word drawn = draw_bits<shapes>(draws, 0, Word{first_bits(shapes)}, chances)[0];
        const Word shape = placed((s.shape << 4) + (actions.rotation << 2) + actions.column);
        // The lowest place that is free.
        Word cells_there = zero, is_blocked{std::uint64_t{1}};
        for (std::size_t k = rows; k-- > 0;) {
            const Word there = shape << static_cast<int>(columns * k) & board;
            const Word meets = there & s.filled;
            cells_there = if_zero(meets, there, cells_there);
            is_blocked = if_zero(meets, zero, is_blocked);
        }
        const Word top = s.filled & row << columns * last_row;
        s.over = is_blocked | if_zero(top, zero, Word{std::uint64_t{1}});
        s.filled = s.filled | cells_there;
        s.shape = first_shape(drawn & first_bits(shapes));
        const Word pairs = s.filled & s.filled >> 1, full = pairs & pairs >> 2 & row_starts;
        if (all(is_zero(full))) return score(zero);
        s.filled = without(s.filled, full);
        return score(bit_count(full));
    }
    template <class L>
    static auto terminated(const State<L>& s) {
        return !is_zero(s.over);
    }
    static constexpr bool broken(const auto&) { return false; }

    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        std::byte values[cells + shapes + 1]{};
        const std::uint64_t filled = lane_of(s.filled, lane);
        for (std::size_t x = 0; x < columns; ++x)
            for (std::size_t y = 0; y < rows; ++y)
                values[x * rows + y] = static_cast<std::byte>(filled >> (y * columns + x) & 1);
        values[cells + lane_of(s.shape, lane)] = std::byte{1};
        values[cells + shapes] = static_cast<std::byte>(lane_of(s.over, lane));
        std::memcpy(record, values, sizeof values);
    }
};

}  // namespace handwritten
