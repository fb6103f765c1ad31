// PushYourLuck_ippc2018 11: three fair dice with ten faces; the faces are the bits of a word.
#pragma once

#include "bools.hpp"

namespace handwritten {

struct PushYourLuck : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 40;
    static constexpr bool stochastic = true;
    static constexpr std::size_t dice = 3, faces = 10, numbers = 20;

    template <class L>
    struct State {
        typename L::Word seen;
    };
    // A bit for each die that is rolled, and one to cash out.
    template <class L>
    struct Actions {
        typename L::Word chosen;
    };
    static constexpr std::uint64_t cash_out = std::uint64_t{1} << dice;

    static void start(State<rddl::Scalar>& state) { state = {0}; }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        state.seen = select(where, std::uint64_t{0}, state.seen);
    }

    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        load_words(actions.chosen, records, dice + 1, bits_of_bytes<dice + 1>);
    }

    // The product of the values of all faces that were seen, and nothing if none was.
    static inline const auto products = [] {
        std::array<double, 1 << faces> all{};
        for (std::size_t seen = 1; seen < all.size(); ++seen) {
            all[seen] = 1;
            for (std::size_t face = 0; face < faces; ++face)
                if (seen >> face & 1) all[seen] *= 0.5 + 0.25 * static_cast<double>(face);
        }
        return all;
    }();
    static double product(std::uint64_t seen) { return products[seen]; }
    template <int n>
    static rddl::Lanes<double, n> product(const rddl::Lanes<std::uint64_t, n>& seen) {
        return gather(products.data(), rddl::ints_of(seen));
    }

    // The face that a number below 2^52 stands for.
    static std::uint64_t face_bit(std::uint64_t number) {
        return std::uint64_t{1} << (number * faces >> 52);
    }
    template <int n>
    static rddl::Lanes<std::uint64_t, n> face_bit(const rddl::Lanes<std::uint64_t, n>& number) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        return Word::each([](auto one, auto face) { return one << face; }, Word{std::uint64_t{1}},
                          ((number << 3) + (number << 1)) >> 52);
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        const Word none{std::uint64_t{0}};
        const auto first = draws.two_integers(none, none),
                   last = draws.two_integers(none, Word{std::uint64_t{1}});
        const Word* const rolls[dice] = {&first.even, &first.odd, &last.even};
        Word met = s.seen, twice = none;
        for (std::size_t d = 0; d < dice; ++d) {
            const Word face =
                if_zero(actions.chosen & std::uint64_t{1} << d, none, face_bit(*rolls[d]));
            twice = twice | (met & face);
            met = met | face;
        }
        const Word cashes = actions.chosen & cash_out;
        const auto reward = product(if_zero(cashes, none, s.seen));
        s.seen = if_zero(twice | cashes, met, none);
        return reward;
    }

    template <class L>
    static void store(const State<L>& state, std::int64_t lane, std::byte* record) {
        store_bits_as_bytes<numbers>(lane_of(state.seen, lane), record);
    }
};

}  // namespace handwritten
