// AcademicAdvising_ippc2018 10: 62 courses, two bits each, of which few are taken in a semester.
#pragma once

#include "academic_advising.hpp"
#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct AcademicAdvising2018 : Courses<std::size(academic_advising_2018::prerequisites)> {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 30;
    static constexpr std::uint64_t program = academic_advising_2018::program[0];

    // The threshold of passing, by the course and the number of those required that are passed.
    static constexpr std::size_t most = 16;
    static constexpr auto chances = [] {
        std::array<std::uint64_t, courses * most> all{};
        for (std::size_t c = 0; c < courses; ++c) {
            const int required = __builtin_popcountll(academic_advising_2018::prerequisites[c]);
            const double prior = academic_advising_2018::prior[c];
            for (int passed = 0; passed <= required; ++passed)
                all.at(c * most + static_cast<std::size_t>(passed)) =
                    threshold(required == 0 ? academic_advising_2018::alone[c]
                                            : prior + (1 - prior) * passed / (1.0 + required));
        }
        return all;
    }();

    template <class Draws>
    static std::uint64_t pass(std::uint64_t passed, std::uint64_t wanted, const Draws& draws) {
        std::uint64_t more = 0;
        for_each_bit(wanted, [&](std::size_t c) {
            const auto count = bit_count(passed & academic_advising_2018::prerequisites[c]);
            more |= std::uint64_t{integer_at(draws, 0, c) < chances[c * most + count]} << c;
        });
        return more;
    }
    // The first course of each environment, then the second, and so on.
    template <int n, class Draws>
    static rddl::Lanes<std::uint64_t, n> pass(const rddl::Lanes<std::uint64_t, n>& passed,
                                              rddl::Lanes<std::uint64_t, n> wanted,
                                              const Draws& draws) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        const Word none{std::uint64_t{0}}, one{std::uint64_t{1}};
        Word more = none;
        while (!all(is_zero(wanted))) {
            const Word rest = wanted & (wanted - one), first = wanted ^ rest;
            const Word course = bit_count(first - one) & std::uint64_t{63};
            const auto numbers = draws.two_integers(none, course >> 1);
            const Word number = if_zero(course & one, numbers.even, numbers.odd);
            const Word required =
                gather_integers(academic_advising_2018::prerequisites, rddl::ints_of(course));
            const Word place = (course << 4) + bit_count(passed & required);
            const Word chance = gather_integers(chances.data(), rddl::ints_of(place));
            more = more | select(is_below(number, chance), first, none);
            wanted = rest;
        }
        return more;
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& state, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        const Word passed = state.passed, take = actions.take;
        const Word missing = (passed & program) ^ Word { program };
        state = {(passed ^ (passed & take)) | pass(passed, take, draws), state.taken | take};
        return -real_of_count(bit_count(take) +
                              if_zero(missing, Word{std::uint64_t{0}}, Word{std::uint64_t{5}}));
    }

    template <class L>
    static void store(const State<L>& state, std::int64_t lane, std::byte* record) {
        store_bits_as_bytes<courses>(lane_of(state.passed, lane), record);
        store_bits_as_bytes<courses>(lane_of(state.taken, lane), record + courses);
    }
};

}  // namespace handwritten
