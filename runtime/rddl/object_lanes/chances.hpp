// Probabilities that are constants: the objects of which a draw needs a random number are known
// when the simulator is compiled, so that they alone have places in registers.
//
// A draw of probability 0 is always false, and one of probability 1 always true.
#pragma once

#include <rddl/lanes/simd.hpp>
#include <rddl/object_lanes/objects.hpp>
#include <rddl/random/random.hpp>
#include <rddl/values/bits.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/few_words.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace rddl {

// Probabilities of many objects, in a table of constants.
template <const auto& table>
struct ChancesOfMany {
    Index first;
};
namespace detail {

template <const auto& table>
using RealOf = std::remove_cvref_t<decltype(first_part<0>(table))>;
template <const auto& table>
inline constexpr std::size_t count_of =
    static_cast<std::size_t>(element_count<std::remove_cvref_t<decltype(table)>>);

// Uniform numbers are multiples of 1 / number_count<R> below 1 (unit_real).
template <class R>
inline constexpr std::int64_t number_count =
    std::int64_t{1} << (std::is_same_v<R, float> ? 23 : 52);

// The bits of 64 that have no part in them.
template <class R>
inline constexpr int unused_bits = std::is_same_v<R, float> ? 41 : 12;

template <class R>
constexpr bool is_certain(R p) {
    return p <= 0 || p > 1 - R(1) / number_count<R>;
}
// How many of the uniform numbers are below p.
template <class R>
constexpr std::int64_t count_below(R p) {
    if (is_certain(p)) return p > 0 ? number_count<R> : 0;
    const R scaled = p * number_count<R>;  // exact
    const auto below = static_cast<std::int64_t>(scaled);
    return below + (static_cast<R>(below) < scaled);
}

template <const auto& table>
inline constexpr bool has_certain_chances = [] {
    for (std::size_t i = 0; i < count_of<table>; ++i)
        if (is_certain(element_at(table, i))) return true;
    return false;
}();

// The objects of a table whose probability is such, in row-major order.
template <const auto& table, class Test>
constexpr auto objects_where(Test test) {
    std::array<bool, count_of<table>> bools{};
    for (std::size_t i = 0; i < bools.size(); ++i) bools[i] = test(element_at(table, i));
    return bools;
}
template <const auto& table>
inline constexpr auto random_objects = objects_where<table>([](RealOf<table> p) {
    return !is_certain(p);
});
template <const auto& table>
inline constexpr auto always_drawn = objects_where<table>([](RealOf<table> p) {
    return is_certain(p) && p > 0;
});

// The pairs of neighbours of which one at least needs a random number, a register of pairs after
// the other; few pairs have a small register. Lanes behind the last pair repeat pair 0, and never
// draw true.
template <const auto& table>
struct RandomPairs {
    using R = RealOf<table>;
    static constexpr std::size_t count = count_of<table>, words = (count + 63) / 64;

    static constexpr bool is_random(std::size_t pair) {
        const auto draws = [](std::size_t i) {
            return i < count && !is_certain(element_at(table, i));
        };
        return draws(2 * pair) || draws(2 * pair + 1);
    }
    static constexpr std::size_t pair_count = [] {
        std::size_t pairs = 0;
        for (std::size_t pair = 0; 2 * pair < count; ++pair) pairs += is_random(pair);
        return pairs;
    }();
    static constexpr std::size_t most_lanes = Context<ScalarOf<R>>::most_pairs;
    using Word = std::conditional_t<pair_count <= FewWords::width, FewWords,
                                    Lanes<std::uint64_t, static_cast<int>(most_lanes)>>;
    static constexpr std::size_t lanes = Word::width;
    static constexpr std::size_t register_count = (pair_count + lanes - 1) / lanes;

    // The random objects of a word that are in a register, the even and the odd ones, and the
    // first lane of their pairs.
    struct Part {
        std::uint64_t even, odd;
        int lane;
    };
    struct Register {
        std::array<std::uint64_t, lanes> pairs{};
        std::array<std::int64_t, lanes> even{}, odd{};  // how many numbers draw true
        std::array<Part, words> parts{};
    };
    static constexpr std::array<Register, register_count> registers = [] {
        std::array<Register, register_count> all{};
        std::size_t next = 0;
        for (std::size_t pair = 0; 2 * pair < count; ++pair) {
            if (!is_random(pair)) continue;
            Register& some = all[next / lanes];
            const std::size_t lane = next++ % lanes;
            some.pairs[lane] = pair;
            some.even[lane] = count_below(element_at(table, 2 * pair));
            if (2 * pair + 1 < count) some.odd[lane] = count_below(element_at(table, 2 * pair + 1));
            Part& part = some.parts[pair / 32];
            if ((part.even | part.odd) == 0) part.lane = static_cast<int>(lane);
            part.even |= std::uint64_t{1} << 2 * pair % 64;
            part.odd |= std::uint64_t{2} << 2 * pair % 64;
        }
        return all;
    }();
    // The objects of a word that draw true by this number, and thus by each smaller one.
    static constexpr std::array<std::uint64_t, words> drawn_by(std::int64_t number) {
        std::array<std::uint64_t, words> all{};
        for (std::size_t i = 0; i < count; ++i)
            all[i / 64] |= std::uint64_t{number < count_below(element_at(table, i))} << i % 64;
        return all;
    }
    static constexpr std::array<std::uint64_t, words> always = drawn_by(number_count<R> - 1),
                                                      by_medians = drawn_by(number_count<R> / 2);
};

// Which of the objects of a table, by words, draw a number below their probability: of those that
// are wanted, at least. The place is that of the first object.
template <const auto& table, class R>
RDDL_INLINE auto drawn_by_pairs(
    const Context<ScalarOf<R>>& context, Place place, const ChancesOfMany<table>&,
    const std::array<std::uint64_t, RandomPairs<table>::words>& wanted) {
    using Pairs = RandomPairs<table>;
    using Word = typename Pairs::Word;
    const StepDraws draws(context);
    if (draws.are_medians) [[unlikely]]
        return Pairs::by_medians;
    auto drawn = Pairs::always;
    for (const typename Pairs::Register& some : Pairs::registers) {
        std::uint64_t needed = 0;
        for (std::size_t w = 0; w < Pairs::words; ++w)
            needed |= wanted[w] & (some.parts[w].even | some.parts[w].odd);
        // One register costs less than a branch that processors foresee wrongly.
        if (Pairs::register_count > 1 && needed == 0) continue;
        philox::Block<Word> words;
        draws.schedule.generate(place.series, Word::load(some.pairs.data()), words);
        const std::uint64_t even =
                                less_words(join_lower_halves(words[0], words[1]) >> unused_bits<R>,
                                           some.even.data()),
                            odd =
                                less_words(join_lower_halves(words[2], words[3]) >> unused_bits<R>,
                                           some.odd.data());
        for (std::size_t w = 0; w < Pairs::words; ++w)
            drawn[w] |= simd::deposited(even >> some.parts[w].lane, some.parts[w].even) |
                        simd::deposited(odd >> some.parts[w].lane, some.parts[w].odd);
    }
    return drawn;
}

}  // namespace detail

// ------------------------------------------------------------------------- of a few objects

// The probability of one object; whether one in its table is 0 or 1.
template <class R, bool some_are_certain>
struct Chance {
    R value;
};
// The probabilities of n objects.
template <const auto& table, int n>
struct SomeChances {
    SomeObjects<n> objects;
};
// Each object takes its own by one of two tables.
template <class Yes, class No, int n>
struct ChosenChances {
    Mask<n> condition;
    Yes yes;
    No no;
};

// The probabilities of objects, of draws.
template <const auto& table>
RDDL_INLINE auto chances(OneObject object) {
    return Chance<detail::RealOf<table>, detail::has_certain_chances<table>>{at(table, object)};
}
template <const auto& table, int n>
RDDL_INLINE auto chances(const SomeObjects<n>& objects) {
    return SomeChances<table, n>{objects};
}
template <class Condition, class R, bool a_certain, bool b_certain>
RDDL_INLINE auto select(const Condition& condition, Chance<R, a_certain> a,
                        Chance<R, b_certain> b) {
    return select(condition, a.value, b.value);
}
template <class Condition, const auto& yes, const auto& no, int n>
RDDL_INLINE auto select(const Condition& condition, SomeChances<yes, n> a, SomeChances<no, n> b) {
    return ChosenChances<SomeChances<yes, n>, SomeChances<no, n>, n>{Mask<n>(condition), a, b};
}

namespace detail {

// The counts of a table, of the even objects and of the odd ones, as long as loads may read.
template <const auto& table>
struct CountsOfPairs {
    static constexpr std::size_t pairs = (count_of<table> + 1) / 2 + objects_at_once / 2;

    static constexpr std::array<std::int64_t, pairs> of_parity(std::size_t parity) {
        std::array<std::int64_t, pairs> counts{};
        for (std::size_t i = parity; i < count_of<table>; i += 2)
            counts[i / 2] = count_below(element_at(table, i));
        return counts;
    }
    static constexpr std::array<std::int64_t, pairs> even = of_parity(0), odd = of_parity(1);
};
// The objects that draw true by the numbers of their pairs.
template <const auto& table, int n, class Words>
RDDL_INLINE std::uint64_t drawn_by(const Words& even, const Words& odd,
                                   const SomeChances<table, n>& p) {
    using Counts = CountsOfPairs<table>;
    const Index first = p.objects.first / 2;
    return simd::deposited(less_words(even, Counts::even.data() + first), 0x5555555555555555) |
           simd::deposited(less_words(odd, Counts::odd.data() + first), 0xAAAAAAAAAAAAAAAA);
}
template <class Yes, class No, int n, class Words>
RDDL_INLINE std::uint64_t drawn_by(const Words& even, const Words& odd,
                                   const ChosenChances<Yes, No, n>& p) {
    const std::uint64_t condition = p.condition.bits;
    return (drawn_by(even, odd, p.yes) & condition) | (drawn_by(even, odd, p.no) & ~condition);
}

// Draws for the objects of a register, whose first has an even index: even and odd ones are
// compared apart, as their numbers are made.
template <class R, int n, class Chances>
RDDL_INLINE Mask<n> drawn(const Context<Objects<n, R>>& context, Place place, const Chances& p) {
    using Word = WordsFor<std::max(n / 2, FewWords::width)>;
    const Word first{std::uint64_t{place.index / 2}};
    philox::Block<Word> words;
    context.draws.schedule.generate(place.series,
                                    first + Word::load(lane_numbers<Word::width>.data()), words);
    const Word median{std::uint64_t{number_count<R> / 2}};
    const auto number = [&](const Word& low, const Word& high) RDDL_INLINE_LAMBDA {
        return context.draws.are_medians ? median : join_lower_halves(low, high) >> unused_bits<R>;
    };
    return Mask<n>::of_bits(drawn_by(number(words[0], words[1]), number(words[2], words[3]), p));
}

}  // namespace detail

namespace sample {

// For one environment, and for packs that take one object after the other.
template <class L, class R, bool some_are_certain>
RDDL_INLINE typename L::Bool valid_bernoulli(Context<L>& context, Place place,
                                             Chance<R, some_are_certain> p) {
    if (some_are_certain && rddl::detail::is_certain(p.value)) return p.value > 0;
    return uniform_at(context, place) < typename L::Real{p.value};
}
template <int n, class R, const auto& table>
RDDL_INLINE Mask<n> valid_bernoulli(Context<Objects<n, R>>& context, Place place,
                                    const SomeChances<table, n>& p) {
    return rddl::detail::drawn<R>(context, place, p);
}
template <int n, class R, class Yes, class No>
RDDL_INLINE Mask<n> valid_bernoulli(Context<Objects<n, R>>& context, Place place,
                                    const ChosenChances<Yes, No, n>& p) {
    return rddl::detail::drawn<R>(context, place, p);
}

}  // namespace sample

}  // namespace rddl
