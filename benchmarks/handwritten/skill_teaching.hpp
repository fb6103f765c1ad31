// SkillTeaching_MDP_ippc2014 10: eight skills, six bits each; a word holds all 48 of a state.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct SkillTeaching : RunsToTheHorizon {
    static constexpr int width = 8;
    static constexpr std::uint64_t horizon = 40;
    static constexpr bool stochastic = true;
    static constexpr std::size_t skills = std::size(skill_teaching::weight);
    static constexpr std::uint64_t all_skills = first_bits(skills);

    template <class L>
    struct State {
        typename L::Word medium, high, turn, answered, hinted, delayed;
    };
    template <class L>
    struct Actions {
        typename L::Word ask, hint;
    };

    static void start(State<rddl::Scalar>& state) { state = {}; }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        for (typename L::Word* const word : {&state.medium, &state.high, &state.turn,
                                             &state.answered, &state.hinted, &state.delayed})
            *word = select(where, std::uint64_t{0}, *word);
    }

    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        typename L::Word both;
        load_words(both, records, 2 * skills, bits_of_bytes<2 * skills>);
        actions = {both & all_skills, both >> int{skills}};
    }

    // By the set of skills that are high: those of which all that they require is among them.
    static constexpr auto all_ready = [] {
        std::array<std::uint64_t, 256> all{};
        for (std::size_t high = 0; high < all.size(); ++high)
            for (std::size_t s = 0; s < skills; ++s)
                if ((skill_teaching::required[s] & ~high) == 0) all[high] |= std::uint64_t{1} << s;
        return all;
    }();
    static std::uint64_t ready(std::uint64_t high) { return all_ready[high]; }
    template <int n>
    static rddl::Lanes<std::uint64_t, n> ready(const rddl::Lanes<std::uint64_t, n>& high) {
        return gather_integers(all_ready.data(), rddl::ints_of(high));
    }

    // Probabilities of a right answer, by what the student knows: the skill well; some of it, with
    // all that it requires, or without; nothing of it, with all that it requires, or without.
    static constexpr Thresholds right_high = Thresholds::of_chances(skill_teaching::prob_high);
    static constexpr Thresholds right_medium_ready =
        Thresholds::of_chances(skill_teaching::prob_all_pre_med);
    static constexpr Thresholds right_ready = Thresholds::of_chances(skill_teaching::prob_all_pre);
    // A probability for each skill that is required.
    static constexpr Thresholds per_required(const double (&chances)[skills]) {
        double sums[skills]{};
        for (std::size_t s = 0; s < skills; ++s)
            for_each_bit(skill_teaching::required[s], [&](std::size_t) { sums[s] += chances[s]; });
        return Thresholds::of_chances(sums);
    }
    static inline const Thresholds right_medium = per_required(skill_teaching::prob_per_pre_med);
    static inline const Thresholds right_otherwise = per_required(skill_teaching::prob_per_pre);
    static constexpr Thresholds keeps = [] {
        double chances[skills];
        for (std::size_t s = 0; s < skills; ++s) chances[s] = 1.0 - skill_teaching::lose_prob[s];
        return Thresholds::of_chances(chances);
    }();

    // The right answers among the skills that are asked.
    template <class Word, class Draws>
    static Word right(const Word& asked, const Word& high, const Word& medium, const Word& is_ready,
                      const Draws& draws) {
        const auto [by_high, by_medium_ready, by_medium, by_ready, by_luck] =
            draw_bits<skills>(draws, 0, asked, right_high, right_medium_ready, right_medium,
                              right_ready, right_otherwise);
        const auto choose = [](const Word& where, const Word& yes, const Word& no) {
            return no ^ ((yes ^ no) & where);
        };
        const Word some = choose(is_ready, by_medium_ready, by_medium);
        const Word none = choose(is_ready, by_ready, by_luck);
        return choose(high, by_high, choose(medium, some, none)) & asked;
    }

    // The sum of the weights of the skills, at most all eight.
    static inline const std::array<double, 256> weights = [] {
        std::array<double, 256> sums{};
        for (std::size_t bits = 0; bits < sums.size(); ++bits)
            for (std::size_t s = 0; s < skills; ++s)
                sums[bits] += (bits >> s & 1) != 0 ? skill_teaching::weight[s] : 0.0;
        return sums;
    }();
    static double weight_of(std::uint64_t bits) { return weights[bits]; }
    template <int n>
    static rddl::Lanes<double, n> weight_of(const rddl::Lanes<std::uint64_t, n>& bits) {
        return gather(weights.data(), rddl::ints_of(bits));
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        const Word none{std::uint64_t{0}}, everywhere{all_skills};
        const auto value = weight_of(s.high) - weight_of(s.medium ^ everywhere);
        // Either there is a turn to evaluate, or the action is taken.
        const Word is_idle = if_zero(s.turn, everywhere, none);
        const Word ask = actions.ask & is_idle, hint = actions.hint & is_idle;
        const Word is_ready = ready(s.high);
        const Word waits = s.turn ^ everywhere;
        const Word at_risk = (s.high & waits) & (is_idle ^ everywhere);
        const auto [kept] = draw_bits<skills>(draws, 5, at_risk, keeps);

        const Word answered_medium = s.medium & s.turn & s.answered;
        const Word kept_high = s.high & s.turn & (s.delayed | s.answered);
        const Word later_high = (at_risk & kept) | answered_medium | kept_high;
        const Word medium = (waits & s.medium) | (s.turn & (s.hinted | s.answered)) | s.high |
                            (s.medium & s.turn & s.delayed);
        s = {medium,          (is_idle & s.high) | (later_high & (is_idle ^ everywhere)),
             ask | hint,      right(ask, s.high, s.medium, is_ready, draws),
             hint & is_ready, hint};
        return value;
    }

    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        for (const auto& word : {s.medium, s.high, s.turn, s.answered, s.hinted, s.delayed}) {
            store_bits_as_bytes<skills>(lane_of(word, lane), record);
            record += skills;
        }
    }
};

}  // namespace handwritten
