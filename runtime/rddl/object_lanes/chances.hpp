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

template <class R>
constexpr bool is_certain(R p) {
    return p <= 0 || p >= 1;
}

template <const auto& table>
inline constexpr bool has_certain_chances = [] {
    for (std::size_t i = 0; i < count_of<table>; ++i)
        if (is_certain(element_at(table, i))) return true;
    return false;
}();

// The pairs of neighbours of which one at least needs a random number, a register of pairs after
// the other. Lanes behind the last pair repeat pair 0, with probabilities 0.
template <const auto& table, std::size_t lanes = Context<ScalarOf<RealOf<table>>>::most_pairs>
struct RandomPairs {
    using R = RealOf<table>;
    static constexpr std::size_t count = count_of<table>, words = (count + 63) / 64,
                                 lane_count = lanes;

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
    // As many numbers are made at once for neighbours that need not be random (many_objects.hpp).
    static constexpr std::size_t chunk_count = [] {
        constexpr std::size_t pairs_of_chunk = 8;
        std::size_t chunks = 0;
        for (std::size_t first = 0; 2 * first < count; first += pairs_of_chunk) {
            bool is_any = false;
            for (std::size_t pair = first; pair < first + pairs_of_chunk; ++pair)
                is_any |= is_random(pair);
            chunks += is_any;
        }
        return chunks;
    }();
    static constexpr std::size_t register_count = (pair_count + lanes - 1) / lanes;

    // The random objects of a word that are in a register, the even and the odd ones, and the
    // first lane of their pairs.
    struct Part {
        std::uint64_t even, odd;
        int lane;
    };
    struct Register {
        std::array<std::uint64_t, lanes> pairs{};
        std::array<R, lanes> even{}, odd{};
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
            some.even[lane] = element_at(table, 2 * pair);
            if (2 * pair + 1 < count) some.odd[lane] = element_at(table, 2 * pair + 1);
            Part& part = some.parts[pair / 32];
            if ((part.even | part.odd) == 0) part.lane = static_cast<int>(lane);
            part.even |= std::uint64_t{1} << 2 * pair % 64;
            part.odd |= std::uint64_t{2} << 2 * pair % 64;
        }
        return all;
    }();
    // The objects of a word whose draws are always true.
    static constexpr std::array<std::uint64_t, words> always = [] {
        std::array<std::uint64_t, words> all{};
        for (std::size_t i = 0; i < count; ++i)
            all[i / 64] |= std::uint64_t{element_at(table, i) >= 1} << i % 64;
        return all;
    }();
};

// Which of the objects of a table, by words, draw a number below their probability: of those that
// are wanted, at least. The place is that of the first object.
template <const auto& table, class R>
RDDL_INLINE auto drawn_by_pairs(
    const Context<ScalarOf<R>>& context, Place place, const ChancesOfMany<table>&,
    const std::array<std::uint64_t, RandomPairs<table>::words>& wanted) {
    using Pairs = RandomPairs<table>;
    constexpr int lanes = static_cast<int>(Pairs::lane_count);
    using Word = Lanes<std::uint64_t, lanes>;
    const StepDraws draws(context);
    auto drawn = Pairs::always;
    for (const typename Pairs::Register& some : Pairs::registers) {
        std::uint64_t needed = 0;
        for (std::size_t w = 0; w < Pairs::words; ++w)
            needed |= wanted[w] & (some.parts[w].even | some.parts[w].odd);
        if (needed == 0) continue;
        philox::Block<Word> words;
        draws.schedule.generate(place.series, Word::load(some.pairs.data()), words);
        const auto bits_below = [&](const auto& number, const R* probabilities) RDDL_INLINE_LAMBDA {
            const auto p = Lanes<R, lanes>::load(probabilities);
            return (draws.are_medians ? Lanes<R, lanes>{R(median_number)} < p : number < p).bits;
        };
        const std::uint64_t even = bits_below(unit_real<R>(words[0], words[1]), some.even.data()),
                            odd = bits_below(unit_real<R>(words[2], words[3]), some.odd.data());
        for (std::size_t w = 0; w < Pairs::words; ++w)
            drawn[w] |= simd::deposited(even >> some.parts[w].lane, some.parts[w].even) |
                        simd::deposited(odd >> some.parts[w].lane, some.parts[w].odd);
    }
    return drawn;
}

}  // namespace detail

// The probability of one object; whether one in its table is 0 or 1.
template <class R, bool some_are_certain>
struct Chance {
    R value;
};

// The probabilities of objects, of draws.
template <const auto& table>
RDDL_INLINE auto chances(OneObject object) {
    return Chance<detail::RealOf<table>, detail::has_certain_chances<table>>{at(table, object)};
}
template <const auto& table, int n>
RDDL_INLINE auto chances(const SomeObjects<n>& objects) {
    return at(table, objects);
}

namespace sample {

// For one environment, and for packs that take one object after the other.
template <class L, class R, bool some_are_certain>
RDDL_INLINE typename L::Bool valid_bernoulli(Context<L>& context, Place place,
                                             Chance<R, some_are_certain> p) {
    if (some_are_certain && detail::is_certain(p.value)) return p.value > 0;
    return uniform_at(context, place) < typename L::Real{p.value};
}

}  // namespace sample

}  // namespace rddl
