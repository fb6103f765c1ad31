// AcademicAdvising_MDP_ippc2014 10: 30 courses, two bits each.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

// Which of so many courses are passed, and which were taken: a bit each.
template <std::size_t course_count>
struct Courses : RunsToTheHorizon {
    static constexpr bool stochastic = true;
    static constexpr std::size_t courses = course_count;

    template <class L>
    struct State {
        typename L::Word passed, taken;
    };
    template <class L>
    struct Actions {
        typename L::Word take;
    };

    static void start(State<rddl::Scalar>& state) { state = {0, 0}; }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        state = {select(where, std::uint64_t{0}, state.passed),
                 select(where, std::uint64_t{0}, state.taken)};
    }

    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        load_words(actions.take, records, courses, bits_of_bytes<courses>);
    }
};

struct AcademicAdvising : Courses<std::size(academic_advising::prerequisites)> {
    static constexpr int width = 8;
    static constexpr std::uint64_t horizon = 40;
    static constexpr std::uint64_t program = academic_advising::program[0];

    // The probability of passing, by the number of courses among those required that are passed.
    static constexpr std::size_t most = 32;
    static constexpr auto chances = [] {
        std::array<std::array<std::uint64_t, most>, courses> all{};
        for (std::size_t c = 0; c < courses; ++c) {
            const int required = __builtin_popcountll(academic_advising::prerequisites[c]);
            for (int passed = 0; passed <= required; ++passed)
                all[c][static_cast<std::size_t>(passed)] =
                    threshold(required == 0 ? 0.8 : 0.2 + (1 - 0.2) * (passed / (1.0 + required)));
        }
        return all;
    }();

    template <class Draws>
    static std::uint64_t pass(std::uint64_t passed, std::uint64_t wanted, const Draws& draws) {
        std::uint64_t more = 0;
        for_each_bit(wanted, [&](std::size_t c) {
            const auto count = bit_count(passed & academic_advising::prerequisites[c]);
            more |= std::uint64_t{integer_at(draws, 0, c) < chances[c][count]} << c;
        });
        return more;
    }
    template <int n, class Draws>
    static rddl::Lanes<std::uint64_t, n> pass(const rddl::Lanes<std::uint64_t, n>& passed,
                                              const rddl::Lanes<std::uint64_t, n>& wanted,
                                              const Draws& draws) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        Word more{std::uint64_t{0}};
        for (std::uint64_t c = 0; c < courses; c += 2) {
            if (all(is_zero(wanted & (std::uint64_t{3} << c)))) continue;
            const auto numbers = draws.two_integers(Word{std::uint64_t{0}}, Word{c / 2});
            const auto passes = [&](std::uint64_t at, const Word& number) {
                const auto count = bit_count(passed & academic_advising::prerequisites[at]);
                const Word chance = gather_integers(chances[at].data(), rddl::ints_of(count));
                return select(is_below(number, chance), Word{std::uint64_t{1} << at},
                              Word{std::uint64_t{0}});
            };
            more = more | passes(c, numbers.even) | passes(c + 1, numbers.odd);
        }
        return more & wanted;
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& state, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        const Word passed = state.passed, taken = state.taken, take = actions.take;
        const Word again = take & taken, missing = (passed & program) ^ Word { program };
        state = {passed | pass(passed, take ^ (take & passed), draws), taken | take};
        return -real_of_count(bit_count(take ^ again)) - 2.0 * real_of_count(bit_count(again)) -
               real_of_count(if_zero(missing, Word{std::uint64_t{0}}, Word{std::uint64_t{5}}));
    }

    template <class L>
    static void store(const State<L>& state, std::int64_t lane, std::byte* record) {
        store_bits_as_bytes<courses>(lane_of(state.passed, lane), record);
        store_bits_as_bytes<courses>(lane_of(state.taken, lane), record + courses);
    }
};

}  // namespace handwritten
