// WildlifePreserve_p10_ippc2018 10: three poachers, each of whom attacks one of eight areas; they
// avoid those that rangers have defended in the last two steps.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct WildlifePreserve : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 30;
    static constexpr bool stochastic = true;
    static constexpr std::size_t areas = 8, rangers = 2, poachers = 3;

    // The areas that were defended one step ago and two steps ago, and the poachers that have just
    // been caught.
    template <class L>
    struct State {
        typename L::Word last, before, caught;
    };
    template <class L>
    struct Actions {
        typename L::Word defended;
    };

    static void start(State<rddl::Scalar>& state) { state = {0, 0, 0}; }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        const std::uint64_t none = 0;
        state = {select(where, none, state.last), select(where, none, state.before),
                 select(where, none, state.caught)};
    }

    // Areas that have a ranger, whose bools lie beside each other.
    static std::uint64_t areas_of(const std::byte* record) {
#ifdef RDDL_SIMD_AVX512
        const __m128i pairs = _mm_loadu_si128(reinterpret_cast<const __m128i*>(record));
        return _mm_test_epi16_mask(pairs, pairs);
#else
        const std::uint64_t bits = bits_of_bytes<areas * rangers>(record);
        return even_bits(bits | bits >> 1);
#endif
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        load_words(actions.defended, records, areas * rangers, areas_of);
    }

    // A bit for the area that each poacher attacks.
    template <class Word>
    struct Attacks {
        Word area[poachers];
    };
    // Registers over the areas.
    template <class Draws>
    static Attacks<std::uint64_t> attacks(const State<rddl::Scalar>& s, const Draws& draws) {
        using Real = rddl::Lanes<double, areas>;
        using Mask = rddl::Mask<areas>;
        const auto first = draws.two(0, 0), last = draws.two(0, 1);
        const double numbers[poachers] = {first.even, first.odd, last.even};
        Attacks<std::uint64_t> attacks;
        for (std::size_t p = 0; p < poachers; ++p) {
            const Real weight =
                select(Mask::of_bits(s.last | s.before), Real::load(wildlife_preserve::once[p]),
                       Real::load(wildlife_preserve::never[p]));
            const Real sums =
                running_sums(select(Mask::of_bits(s.last & s.before), Real{0.0}, weight));
            const auto passed = sums <= Real{numbers[p] * sums[areas - 1]};
            attacks.area[p] = std::uint64_t{1} << bit_count(passed.bits);
        }
        return attacks;
    }
    // The sums of each lane and all lanes before it.
    static rddl::Lanes<double, areas> running_sums(rddl::Lanes<double, areas> values) {
#ifdef RDDL_SIMD_AVX512
        __m512d& sums = values.part[0];
        const __m512i zero = _mm512_setzero_si512();
        sums += (__m512d)_mm512_alignr_epi64((__m512i)sums, zero, areas - 1);
        sums += (__m512d)_mm512_alignr_epi64((__m512i)sums, zero, areas - 2);
        sums += (__m512d)_mm512_alignr_epi64((__m512i)sums, zero, areas - 4);
#else
        for (int a = 1; a < static_cast<int>(areas); ++a) values.set(a, values[a - 1] + values[a]);
#endif
        return values;
    }
    // Registers over environments.
    template <int n, class Draws>
    static Attacks<rddl::Lanes<std::uint64_t, n>> attacks(const State<rddl::Pack<n>>& s,
                                                          const Draws& draws) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        using Real = rddl::Lanes<double, n>;
        const Word zero{std::uint64_t{0}}, one{std::uint64_t{1}};
        const auto first = draws.two(zero, zero), last = draws.two(zero, one);
        const Real* const numbers[poachers] = {&first.even, &first.odd, &last.even};
        const Word any = s.last | s.before, both = s.last & s.before;
        Real sums[poachers][areas];
        for (std::size_t a = 0; a < areas; ++a) {
            const auto is_never = is_zero(any & (std::uint64_t{1} << a));
            const auto is_twice = !is_zero(both & (std::uint64_t{1} << a));
            for (std::size_t p = 0; p < poachers; ++p) {
                const Real weight = select(is_never, Real{wildlife_preserve::never[p][a]},
                                           Real{wildlife_preserve::once[p][a]});
                const Real counted = select(is_twice, Real{0.0}, weight);
                sums[p][a] = a == 0 ? counted : sums[p][a - 1] + counted;
            }
        }
        Attacks<Word> attacks;
        for (std::size_t p = 0; p < poachers; ++p) {
            const Real limit = *numbers[p] * sums[p][areas - 1];
            attacks.area[p] = one;
            for (std::size_t a = 1; a < areas; ++a)
                attacks.area[p] =
                    select(sums[p][a - 1] <= limit, Word{std::uint64_t{1} << a}, attacks.area[p]);
        }
        return attacks;
    }

    // By the set of the areas that were attacked and not defended.
    static constexpr auto rewards = [] {
        std::array<double, 1 << areas> all{};
        for (std::size_t lost = 0; lost < all.size(); ++lost)
            for (std::size_t a = 0; a < areas; ++a)
                all[lost] +=
                    lost >> a & 1 ? wildlife_preserve::penalty[a] : wildlife_preserve::reward[a];
        return all;
    }();
    static double reward(std::uint64_t lost) {
        return rewards[lost];
    }
    template <int n>
    static rddl::Lanes<double, n> reward(const rddl::Lanes<std::uint64_t, n>& lost) {
        return gather(rewards.data(), rddl::ints_of(lost));
    }

    // A poacher who has just been caught takes nothing.
    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        const Word none{std::uint64_t{0}}, defended = actions.defended;
        const auto attacked = attacks(s, draws);
        Word lost = none, caught = none;
        for (std::size_t p = 0; p < poachers; ++p) {
            const std::uint64_t poacher = std::uint64_t{1} << p;
            const Word area = attacked.area[p], met = area & defended;
            caught = caught | if_zero(met, none, Word{poacher});
            lost = lost | if_zero(s.caught & poacher, area ^ met, none);
        }
        s = {defended, s.last, caught};
        return reward(lost);
    }

    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        const std::uint64_t last = lane_of(s.last, lane), before = lane_of(s.before, lane);
        store_bits_as_bytes<2 * areas>(to_even_bits(last) | to_even_bits(before) << 1, record);
        store_bits_as_bytes<poachers>(lane_of(s.caught, lane), record + 2 * areas);
    }
};

}  // namespace handwritten
