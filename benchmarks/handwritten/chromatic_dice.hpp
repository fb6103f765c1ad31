// ChromaticDice_ippc2018 10: five dice that show a value and a colour, rolled three times before
// they are assigned to a category. Relies on legal actions: at most one category at a time.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

// A face for each number below 2^52. An eighth of the numbers meets one limit between faces at
// most.
struct Faces {
    std::uint64_t first[8], limit[8];

    template <std::size_t count>
    static constexpr Faces of(const double (&chances)[count]) {
        Faces faces{};
        for (std::uint64_t eighth = 0; eighth < 8; ++eighth) {
            const std::uint64_t low = eighth << 49, high = (eighth + 1) << 49;
            faces.limit[eighth] = high;
            double sum = 0;
            for (const double chance : chances) {
                const std::uint64_t limit = threshold(sum += chance);
                if (limit <= low)
                    ++faces.first[eighth];
                else if (limit < high)
                    faces.limit[eighth] = limit;
            }
        }
        return faces;
    }
    template <class Word>
    Word face(const Word& number) const {
        const Word eighth = number >> 49, low = entry_of_eight(first, eighth);
        return select(is_below(number, entry_of_eight(limit, eighth)), low,
                      low + Word{std::uint64_t{1}});
    }
};

struct ChromaticDice : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 86;
    static constexpr bool stochastic = true;
    static constexpr std::size_t dice = 5, values = 6, colors = 5, categories = 24;

    enum Phase : std::uint64_t { roll_1, roll_2, roll_3, assign, receive_boni, finish };
    enum Category : std::uint64_t {
        reds = values,
        two_pairs = values + colors,
        three_of_a_kind,
        four_of_a_kind,
        full_house,
        small_straight,
        large_straight,
        chance,
        five_of_a_kind,
        three_of_a_color,
        four_of_a_color,
        color_full_house,
        flush,
        rainbow  // never scores: each die has the colour of itself
    };
    static constexpr std::uint64_t bit(std::uint64_t category) {
        return std::uint64_t{1} << category;
    }

    // Values and colours in the order of the draws: a row for even dice, another one for odd.
    static constexpr std::size_t color_lane = 3, lanes = 8;
    template <class L>
    struct State {
        using Word = typename L::Word;
        Word faces[2][lanes];
        Word phase, taken, value_level, color_level, receives_value, receives_color;

        const Word& value(std::size_t die) const { return faces[die % 2][die / 2]; }
        const Word& color(std::size_t die) const { return faces[die % 2][color_lane + die / 2]; }
    };
    template <class L>
    struct Actions {
        typename L::Word rolled, category;
    };

    static void start(State<rddl::Scalar>& s) {
        s = {};
        for (auto& row : s.faces)
            for (std::size_t lane = color_lane; lane < lanes; ++lane) row[lane] = blue;
        s.taken = chromatic_dice::taken;
        s.value_level = s.color_level = chromatic_dice::level;
    }
    static constexpr std::uint64_t blue = 2;
    template <class L>
    static void start(State<L>& s, typename L::Bool where) {
        State<rddl::Scalar> first;
        start(first);
        const auto set = [&](auto& value, std::uint64_t to) {
            value = select(where, to, value);
        };
        for (std::size_t row = 0; row < 2; ++row)
            for (std::size_t lane = 0; lane < lanes; ++lane)
                set(s.faces[row][lane], first.faces[row][lane]);
        set(s.phase, first.phase);
        set(s.taken, first.taken);
        set(s.value_level, first.value_level);
        set(s.color_level, first.color_level);
        set(s.receives_value, first.receives_value);
        set(s.receives_color, first.receives_color);
    }

    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        constexpr std::size_t all = dice + categories;
        typename L::Word bools;
        load_words(bools, records, all, bits_of_bytes<all>);
        actions.rolled = bools & first_bits(dice);
        actions.category = bools >> static_cast<int>(dice);
    }

    // --------------------------------------------------------------------------------- draws

    static constexpr Faces value_faces = Faces::of(chromatic_dice::value_chances),
                           color_faces = Faces::of(chromatic_dice::color_chances);
    enum Site : std::uint64_t { color_site, value_site };

    // One register for all.
    template <class Draws>
    static void roll(State<rddl::Scalar>& s, std::uint64_t rolled, const Draws& draws) {
        using Word = rddl::Lanes<std::uint64_t, lanes>;
        static constexpr std::uint64_t sites[lanes] = {value_site, value_site, value_site,
                                                       color_site, color_site, color_site};
        static constexpr std::uint64_t blocks[lanes] = {0, 1, 2, 0, 1, 2};
        const handwritten::Draws<Word> many{Word{draws.step},
                                            {Word{draws.key[0]}, Word{draws.key[1]}}};
        const auto numbers = many.two_integers(Word::load(sites), Word::load(blocks));
        const auto keep = [&](std::uint64_t(&row)[lanes], const Word& number, std::uint64_t dice) {
            const auto are_colors = rddl::Mask<lanes>::of_bits(first_bits(lanes) << color_lane);
            const Word faces =
                select(are_colors, color_faces.face(number), value_faces.face(number));
            const auto where = rddl::Mask<lanes>::of_bits(dice | dice << color_lane);
            select(where, faces, Word::load(row)).store(row);
        };
        keep(s.faces[0], numbers.even, even_bits(rolled));
        keep(s.faces[1], numbers.odd, even_bits(rolled >> 1));
    }
    // Registers over environments.
    template <int n, class Draws>
    static void roll(State<rddl::Pack<n>>& s, const rddl::Lanes<std::uint64_t, n>& rolled,
                     const Draws& draws) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        for (std::uint64_t pair = 0; pair < (dice + 1) / 2; ++pair) {
            const auto value = draws.two_integers(Word{std::uint64_t{value_site}}, Word{pair});
            const auto color = draws.two_integers(Word{std::uint64_t{color_site}}, Word{pair});
            const auto keep = [&](auto& row, std::uint64_t die, const Word& its_value,
                                  const Word& its_color) {
                const auto stays = is_zero(rolled & std::uint64_t{1} << die);
                row[pair] = select(stays, row[pair], value_faces.face(its_value));
                row[color_lane + pair] =
                    select(stays, row[color_lane + pair], color_faces.face(its_color));
            };
            keep(s.faces[0], 2 * pair, value.even, color.even);
            if (2 * pair + 1 < dice) keep(s.faces[1], 2 * pair + 1, value.odd, color.odd);
        }
    }

    // --------------------------------------------------------------------------------- scores

    // A byte for each value or colour: how many dice show it, above the sum of their values.
    static constexpr int sum_bits = 5;
    static constexpr std::uint64_t each = 0x0101010101010101, sum = first_bits(sum_bits);
    // By value: what a die adds to its byte. By colour: where its byte is. The bytes of colours are
    // in the order of their categories.
    static constexpr std::uint64_t one_die = std::uint64_t{1} << sum_bits;
    static constexpr std::uint64_t of_values[lanes] = {one_die | 1, one_die | 2, one_die | 3,
                                                       one_die | 4, one_die | 5, one_die | 6};
    static constexpr std::uint64_t in_values[lanes] = {of_values[0],       of_values[1] << 8,
                                                       of_values[2] << 16, of_values[3] << 24,
                                                       of_values[4] << 32, of_values[5] << 40};
    static constexpr std::uint64_t places[lanes] = {0, 8, 24, 16, 32};

    static std::uint64_t shifted(std::uint64_t word, std::uint64_t by) { return word << by; }
    static std::uint64_t shifted_back(std::uint64_t word, std::uint64_t by) { return word >> by; }
    template <int n>
    static auto shifted(const rddl::Lanes<std::uint64_t, n>& word,
                        const rddl::Lanes<std::uint64_t, n>& by) {
        return word.each([](auto a, auto b) { return a << b; }, word, by);
    }
    template <int n>
    static auto shifted_back(const rddl::Lanes<std::uint64_t, n>& word,
                             const rddl::Lanes<std::uint64_t, n>& by) {
        return word.each([](auto a, auto b) { return a >> b; }, word, by);
    }

    // The categories of the lower section whose condition the dice meet, and the sums that count.
    template <class Word>
    struct Lower {
        Word met, of_all, of_color;
    };
    template <class Word>
    static Lower<Word> lower(const Word& values, const Word& colors, const Word& sum_of_all) {
        const Word zero{std::uint64_t{0}};
        const auto if_not = [&](const Word& condition, std::uint64_t categories) {
            return if_zero(condition, Word{categories}, zero);
        };
        const auto if_any = [&](const Word& condition, std::uint64_t categories) {
            return if_zero(condition, zero, Word{categories});
        };
        // How many, as the lowest three bits of bytes.
        const Word value = values >> sum_bits & 7 * each, color = colors >> sum_bits & 7 * each;
        const auto three = [](const Word& count) {
            return (count + Word{5 * each}) >> 3 & each;
        };
        const auto four = [](const Word& count) {
            return count & 4 * each;
        };
        const auto five = [](const Word& count) {
            return count & count >> 2 & each;
        };
        const auto one = [](const Word& count) {  // where one die alone
            return (count & each) ^ (count & each & (count >> 1 | count >> 2));
        };
        const Word pairs = value >> 1 & each, is_pair = pairs & (pairs - Word{std::uint64_t{1}});
        const Word shown = (value | value >> 1 | value >> 2) & each;
        const Word four_in_row = shown & shown >> 8 & shown >> 16 & shown >> 24;
        const Word most = three(color);
        const Word met =
            if_any(is_pair | four(value), bit(two_pairs)) |
            if_any(three(value), bit(three_of_a_kind)) | if_any(four(value), bit(four_of_a_kind)) |
            if_not(one(value), bit(full_house)) | if_any(four_in_row, bit(small_straight)) |
            if_any(four_in_row & shown >> 32, bit(large_straight)) | bit(chance) |
            if_any(five(value), bit(five_of_a_kind)) | if_any(most, bit(three_of_a_color)) |
            if_any(four(color), bit(four_of_a_color)) | if_not(one(color), bit(color_full_house)) |
            if_any(five(color), bit(flush));
        const Word of_most = colors & ((most << sum_bits) - most);
        const Word half = of_most | of_most >> 32, quarter = half | half >> 16;
        return {met, sum_of_all, (quarter | quarter >> 8) & sum};
    }
    template <class Word>
    static Word lower_score(const Lower<Word>& lower, const Word& category) {
        const auto fixed = [&](std::uint64_t its, std::uint64_t score, const Word& others) {
            return if_zero(category & bit(its), others, Word{score});
        };
        constexpr std::uint64_t all =
            bit(two_pairs) | bit(three_of_a_kind) | bit(four_of_a_kind) | bit(chance) | bit(flush);
        constexpr std::uint64_t of_color = bit(three_of_a_color) | bit(four_of_a_color);
        Word score = if_zero(category & of_color, Word{std::uint64_t{20}}, lower.of_color);
        score = if_zero(category & all, score, lower.of_all);
        score = fixed(five_of_a_kind, 50, fixed(large_straight, 40, score));
        score = fixed(full_house, 25, fixed(small_straight, 30, score));
        return if_zero(category & lower.met, Word{std::uint64_t{0}}, score);
    }

    // Three dice keep the level, each one more or less moves it by one.
    template <class Word>
    static Word next_level(const Word& level, const Word& count) {
        const Word raised = level + count, zero{std::uint64_t{0}}, most{values - 1};
        return select(
            is_below(raised, Word{std::uint64_t{4}}), zero,
            select(is_below(raised, Word{values + 2}), raised - Word{std::uint64_t{3}}, most));
    }

    // For environments that assign.
    template <class L>
    static typename L::Word assign_to(State<L>& s, const typename L::Word& category) {
        using Word = typename L::Word;
        const Word zero{std::uint64_t{0}};
        Word by_value = zero, by_color = zero, sum_of_all = zero;
        for (std::size_t die = 0; die < dice; ++die) {
            by_value = by_value + entry_of_eight(in_values, s.value(die));
            by_color = by_color + shifted(entry_of_eight(of_values, s.value(die)),
                                          entry_of_eight(places, s.color(die)));
            sum_of_all = sum_of_all + s.value(die);
        }
        sum_of_all = sum_of_all + Word{dice};
        // The categories of the upper and the middle section.
        const Word upper = category & first_bits(values),
                   middle = category >> values & first_bits(colors), either = upper | middle;
        const Word place = bit_count(either - Word{std::uint64_t{1}}) << 3;
        const Word byte = shifted_back(if_zero(middle, by_value, by_color), place) & 0xff;
        const Word count = byte >> sum_bits;
        s.value_level = if_zero(upper, s.value_level, next_level(s.value_level, count));
        s.color_level = if_zero(middle, s.color_level, next_level(s.color_level, count));
        return if_zero(either, lower_score(lower(by_value, by_color, sum_of_all), category),
                       byte & sum);
    }

    // --------------------------------------------------------------------------------- a step

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        const Word zero{std::uint64_t{0}}, one{std::uint64_t{1}};
        const auto is_phase = [&](Phase phase, const Word& then) {
            return if_zero(s.phase ^ std::uint64_t{phase}, then, zero);
        };
        Word score = is_phase(finish, if_zero(s.receives_value, zero, Word{std::uint64_t{45}}) +
                                          if_zero(s.receives_color, zero, Word{std::uint64_t{40}}));
        const auto high = [&](const Word& level) {
            return is_phase(receive_boni,
                            select(is_below(level, Word{chromatic_dice::level}), zero, one));
        };
        s.receives_value = high(s.value_level);
        s.receives_color = high(s.color_level);
        if (!all(is_zero(actions.category)))
            score = score + if_zero(actions.category, zero, assign_to(s, actions.category));
        if (!all(is_zero(actions.rolled))) roll(s, actions.rolled, draws);

        const Word every{first_bits(categories)}, taken = s.taken | actions.category;
        const Word next = if_zero(s.taken ^ every, Word{std::uint64_t{finish}},
                                  (s.phase + one) & std::uint64_t{3});
        const Word is_receiving = is_phase(receive_boni, one);
        s.phase = if_zero((taken ^ every) | is_receiving, Word{std::uint64_t{receive_boni}}, next);
        s.taken = taken;
        return real_of_count(score);
    }

    struct Record {
        std::uint64_t value[dice], color[dice], phase;
        std::byte taken[categories];
        std::uint64_t value_level, color_level;
        std::byte receives_value, receives_color;
    };
    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        Record values{};
        for (std::size_t die = 0; die < dice; ++die) {
            values.value[die] = lane_of(s.value(die), lane);
            values.color[die] = lane_of(s.color(die), lane);
        }
        values.phase = lane_of(s.phase, lane);
        store_bits_as_bytes<categories>(lane_of(s.taken, lane), values.taken);
        values.value_level = lane_of(s.value_level, lane);
        values.color_level = lane_of(s.color_level, lane);
        values.receives_value = static_cast<std::byte>(lane_of(s.receives_value, lane));
        values.receives_color = static_cast<std::byte>(lane_of(s.receives_color, lane));
        std::memcpy(record, &values, sizeof values);
    }
};

}  // namespace handwritten
