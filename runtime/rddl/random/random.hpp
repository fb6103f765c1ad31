// Random numbers as a pure function of what they are for (docs/randomness.md).
//
// An episode has a stream key made from (seed, environment, episode); a draw has the coordinates
// (step, series, index) in that stream. So a draw depends neither on what was drawn before it nor
// on batches, threads or machines.
//
// Over 400 lines: what the numbers of a draw are has one place, for one environment and for packs.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/pack_ops.hpp>
#include <rddl/values/philox.hpp>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace rddl {

// Stream keys, each half in the lower half of a word.
template <class Word>
struct StreamKeys {
    Word low, high;
};
template <class Word>
RDDL_INLINE StreamKeys<Word> stream_keys(const Word& seed, const Word& environment,
                                         const Word& episode) {
    const philox::Block<Word> block = philox::generate<philox::key_rounds>(
        philox::Block<Word>{environment, environment >> 32, episode, episode >> 32},
        philox::Key<Word>{seed, seed >> 32});
    const Word lower_half{std::uint64_t{0xFFFFFFFF}};
    return {block[0] & lower_half, block[1] & lower_half};
}
constexpr StreamKey stream_key(std::uint64_t seed, std::uint64_t environment,
                               std::uint64_t episode) {
    const auto keys = stream_keys(seed, environment, episode);
    return {static_cast<std::uint32_t>(keys.low), static_cast<std::uint32_t>(keys.high)};
}

namespace detail {

// The upper 23 bits of a word in the lower half, as the fraction of a number in [0, 1).
template <class Word>
RDDL_INLINE auto unit_float(Word high) {
    const auto bits = lower_halves(high);
    return real_of_bits((bits >> 9) | decltype(bits){rddl::bits_of(1.0f)}) - 1.0f;
}

}  // namespace detail

// The upper 52 bits of a number of 64: a multiple of 2^-52 in [0, 1). Floats take the upper 23, so
// the double rounded down.
template <class R = double, class Word>
RDDL_INLINE auto unit_real(Word bits) {
    using philox::upper_halves;  // of one word
    if constexpr (std::same_as<R, float>)
        return detail::unit_float(upper_halves(bits));
    else
        return real_of_bits((bits >> 12) | Word{bits_of(1.0)}) - 1.0;
}
// The unit real of a number's two words, low word first.
template <class R = double, class Word>
RDDL_INLINE auto unit_real(Word low, Word high) {
    if constexpr (std::same_as<R, float>)
        return detail::unit_float(high);
    else
        return unit_real<R>(join_lower_halves(low, high));
}
// A number in (0, 1), symmetric about 1/2: neither 0 nor 1 occurs. Exact.
template <RealLanes Real>
RDDL_INLINE Real open_unit_real(Real unit) {
    return unit + 0x1p-53;
}
template <FloatLanes Real>
RDDL_INLINE Real open_unit_real(Real unit) {
    return unit + 0x1p-24f;
}

// Each uniform number in a stream of median_key.
inline constexpr double median_number = 0.5;

template <int n>
RDDL_INLINE Mask<n> is_median_key(const Lanes<std::uint64_t, n>& low,
                                  const Lanes<std::uint64_t, n>& high) {
    using Int = Lanes<std::int64_t, n>;
    return ints_of(low) == Int{std::int64_t{median_key.low}} &&
           ints_of(high) == Int{std::int64_t{median_key.high}};
}

// ------------------------------------------------------------------- one number of each draw

// A counter value gives two numbers. They are the first ones of two draws, whose indices differ
// in the last bit.
template <class Real>
struct TwoDraws {
    Real even, odd;
};

template <class R, class Word>
RDDL_INLINE auto first_numbers(Word step, Word series, Word block_number,
                               const philox::Key<Word>& key) {
    const philox::Block<Word> words = philox::generate<philox::draw_rounds>(
        philox::Block<Word>{step, series, block_number, Word{std::uint64_t{0}}}, key);
    const auto even = unit_real<R>(words[0], words[1]);
    const auto odd = unit_real<R>(words[2], words[3]);
    return TwoDraws<std::remove_const_t<decltype(even)>>{even, odd};
}

// A loop draws for one index after the other, so some are made at once: for packs those of as many
// as keep the processor busy, for one environment those of as many pairs as a register has lanes.
template <int n, class R>
inline constexpr std::uint32_t numbers_at_once = n / simd::lanes_of<std::uint64_t> <= 2 ? 4 : 2;

// Calls use(schedule, i) for each part of the lanes whose numbers are made in registers alone.
template <int n, class R, class Use>
RDDL_INLINE void for_each_schedule(const Context<Pack<n, R>>& context, Use&& use) {
    if constexpr (Context<Pack<n, R>>::keeps_schedule) {
        use(context.schedule, 0);
    } else {
        constexpr int together = 16;
        using Some = Lanes<std::uint64_t, together>;
        for (std::size_t i = 0; i < n / together; ++i) {
            const philox::Key<Some> key{part_of<Some>(context.key_low, i),
                                        part_of<Some>(context.key_high, i)};
            use(philox::Schedule<philox::draw_rounds, Some>(part_of<Some>(context.step, i), key),
                i);
        }
    }
}

template <int n, class R>
RDDL_INLINE void make_schedule(Context<Pack<n, R>>& context) {
    if (context.is_scheduled) return;
    if constexpr (Context<Pack<n, R>>::keeps_schedule)
        context.schedule.begin(context.step, {context.key_low, context.key_high});
    context.draws_medians = is_median_key(context.key_low, context.key_high);
    context.is_scheduled = true;
}

// The numbers of `count` neighbouring indices from an even one on.
template <std::uint32_t count, int n, class R>
RDDL_INLINE void make_numbers(Context<Pack<n, R>>& context, std::uint32_t series,
                              std::uint32_t first, Lanes<R, n>* numbers) {
    make_schedule(context);
    const std::uint64_t third = first / 2;
    for_each_schedule(
        context, [&]<class Word>(const philox::Schedule<philox::draw_rounds, Word>& schedule,
                                 std::size_t i) RDDL_INLINE_LAMBDA {
            const auto store = [&](const philox::Block<Word>& words, Lanes<R, n>* pair)
                                   RDDL_INLINE_LAMBDA {
                                       set_part(pair[0], i, unit_real<R>(words[0], words[1]));
                                       set_part(pair[1], i, unit_real<R>(words[2], words[3]));
                                   };
            philox::Block<Word> words[count / 2];
            schedule.generate(series, third, words);
            for (std::size_t k = 0; k < count / 2; ++k) store(words[k], numbers + 2 * k);
        });
    if (any(context.draws_medians))
        for (std::uint32_t k = 0; k < count; ++k)
            numbers[k] = select(context.draws_medians, Lanes<R, n>{R(median_number)}, numbers[k]);
}

// Numbers, not a place: what compilers pass through memory is read slowly.
template <std::uint32_t count, int n, class R>
[[gnu::noinline]] void refill(Context<Pack<n, R>>& context, std::uint32_t series,
                              std::uint32_t index) {
    auto& recent = context.recent[series % recent_series];
    recent.series = series;
    recent.first = index / count * count;
    recent.count = count;
    make_numbers<count>(context, series, recent.first, recent.numbers);
}

template <int n, class R>
RDDL_INLINE Lanes<R, n> uniform_at(Context<Pack<n, R>>& context, Place place) {
    const auto& recent = context.recent[place.series % recent_series];
    if (!recent.has(place)) {
        if (__builtin_constant_p(place.index))
            refill<2>(context, place.series, place.index);  // most likely there is no other one
        else
            refill<numbers_at_once<n, R>>(context, place.series, place.index);
    }
    return recent.numbers[place.index - recent.first];
}

// The number of one of `count` draws of a loop: those of no other objects are made with it.
template <int n, class R, Index count>
RDDL_INLINE Lanes<R, n> uniform_at(Context<Pack<n, R>>& context, PlaceAmong<count> place) {
    constexpr std::uint32_t at_once = numbers_at_once<n, R>, all = count, rest = all % at_once;
    const auto& recent = context.recent[place.series % recent_series];
    if (!recent.has(place)) {
        if (rest > 0 && rest <= 2 && place.index >= all - rest)
            refill<2>(context, place.series, place.index);
        else
            refill<at_once>(context, place.series, place.index);
    }
    return recent.numbers[place.index - recent.first];
}

// The number of a draw that is made once in a step, where it is used. More lanes do not fit into
// the processor's registers.
template <int n, class R, std::same_as<LonePlace> Lone>
requires(n <= 16) RDDL_INLINE Lanes<R, n> uniform_at(Context<Pack<n, R>>& context, Lone place) {
    using Word = Lanes<std::uint64_t, n>;
    const auto numbers = first_numbers<R, Word>(context.step, Word{std::uint64_t{place.series}},
                                                Word{std::uint64_t{place.index / 2}},
                                                {context.key_low, context.key_high});
    const auto& random = place.index % 2 == 0 ? numbers.even : numbers.odd;
    const Mask<n> are_medians = is_median_key(context.key_low, context.key_high);
    if (any(are_medians)) return select(are_medians, Lanes<R, n>{R(median_number)}, random);
    return random;
}
template <class R, std::same_as<LonePlace> Lone>
RDDL_INLINE R uniform_at(Context<ScalarOf<R>>& context, Lone place) {
    if (context.key == median_key) return R(median_number);
    const auto numbers = first_numbers<R, std::uint64_t>(
        context.step, place.series, place.index / 2, {context.key.low, context.key.high});
    return place.index % 2 == 0 ? numbers.even : numbers.odd;
}

// Whether a uniform number is below p, in the lanes of a mask. Where few lanes need their numbers,
// they are generated lane by lane.
template <int n, class R, class Probability>
RDDL_INLINE Mask<n> uniform_below(Context<Pack<n, R>>& context, Place place, Mask<n> wanted,
                                  const Probability& p) {
    constexpr int few = n / 8;
    if (__builtin_popcountll(wanted.bits) > few)
        return wanted && uniform_at(context, place) < Lanes<R, n>(p);
    Mask<n> below = wanted;
    for_each_lane(wanted, [&](int lane) RDDL_INLINE_LAMBDA {
        const auto numbers =
            first_numbers<R, std::uint64_t>(context.step[lane], place.series, place.index / 2,
                                            {context.key_low[lane], context.key_high[lane]});
        const R random = place.index % 2 == 0 ? numbers.even : numbers.odd;
        const R u = context.key(lane) == median_key ? R(median_number) : random;
        if (!(u < get_lane(p, lane))) below.set(lane, false);
    });
    return below;
}

namespace detail {

// 0, 1, 2, ...
template <int n>
inline constexpr auto lane_numbers = [] {
    std::array<std::uint64_t, static_cast<std::size_t>(n)> numbers{};
    for (std::size_t lane = 0; lane < numbers.size(); ++lane) numbers[lane] = lane;
    return numbers;
}();

}  // namespace detail

// The standard distribution that a uniform number becomes before parameters have a part in it: here
// the uniform one itself (others: distributions/continuous.hpp).
struct Uniform {
    static constexpr std::uint32_t kind = 0;
    template <class Real>
    static RDDL_INLINE Real of(const Real& number) {
        return number;
    }
};

// How many pairs of neighbours are made at once: of uniform numbers as many as a register has
// words, or floats if these are fewer than 8.
template <class Standard, class R>
inline constexpr int pairs_at_once = Standard::kind == Uniform::kind
                                         ? std::min(simd::lanes_of<R>,
                                                    Context<ScalarOf<R>>::most_pairs)
                                         : Context<ScalarOf<R>>::most_pairs;

// Keeps the numbers of a register of pairs.
template <class Standard, class R, class Real>
RDDL_INLINE void keep(Context<ScalarOf<R>>& context, std::uint32_t series, std::uint32_t kind,
                      std::uint32_t chunk, const TwoDraws<Real>& made) {
    auto& recent = context.recent[(series + kind) % recent_series];
    recent.series = series;
    recent.kind = kind;
    recent.chunk = chunk;
    Standard::of(made.even).store(recent.numbers[0]);
    Standard::of(made.odd).store(recent.numbers[1]);
    if (context.key == median_key) [[unlikely]]
        for (R(&numbers)[Context<ScalarOf<R>>::most_pairs] : recent.numbers)
            Standard::of(Real{R(median_number)}).store(numbers);
}

template <class Standard, class R>
[[gnu::noinline]] void refill(Context<ScalarOf<R>>& context, std::uint32_t series,
                              std::uint32_t chunk) {
    constexpr int lanes = pairs_at_once<Standard, R>;
    using Word = Lanes<std::uint64_t, lanes>;
    const Word first{std::uint64_t{chunk} * lanes};
    const auto made = first_numbers<R, Word>(
        Word{std::uint64_t{context.step}}, Word{std::uint64_t{series}},
        first + Word::load(detail::lane_numbers<lanes>.data()),
        {Word{std::uint64_t{context.key.low}}, Word{std::uint64_t{context.key.high}}});
    keep<Standard>(context, series, Standard::kind, chunk, made);
}

template <class Standard, class R>
RDDL_INLINE R recent_number(Context<ScalarOf<R>>& context, Place place) {
    constexpr int pairs = pairs_at_once<Standard, R>;
    const std::uint32_t chunk = place.index / 2 / pairs;
    const auto& recent = context.recent[(place.series + Standard::kind) % recent_series];
    const bool is_there =
        recent.series == place.series && recent.kind == Standard::kind && recent.chunk == chunk;
    if (!is_there) refill<Standard>(context, place.series, chunk);
    return recent.numbers[place.index % 2][place.index / 2 % pairs];
}

template <class R>
RDDL_INLINE R uniform_at(Context<ScalarOf<R>>& context, Place place) {
    return recent_number<Uniform>(context, place);
}

// A register has the numbers of so many neighbouring sites, whose indices are the same up to the
// last bit.
template <class R>
inline constexpr std::uint32_t sites_at_once = pairs_at_once<Uniform, R>;
inline constexpr std::uint32_t kind_of_sites = 3;  // no standard distribution has it

template <class R>
[[gnu::noinline]] void refill_sites(Context<ScalarOf<R>>& context, std::uint32_t chunk,
                                    std::uint32_t pair) {
    using Word = Lanes<std::uint64_t, sites_at_once<R>>;
    const Word first{std::uint64_t{chunk} * sites_at_once<R>};
    const auto made = first_numbers<R, Word>(
        Word{std::uint64_t{context.step}},
        first + Word::load(detail::lane_numbers<sites_at_once<R>>.data()),
        Word{std::uint64_t{pair}},
        {Word{std::uint64_t{context.key.low}}, Word{std::uint64_t{context.key.high}}});
    keep<Uniform>(context, chunk, kind_of_sites, pair, made);
}
template <class R, std::same_as<PlaceAmongSites> Among>
RDDL_INLINE R uniform_at(Context<ScalarOf<R>>& context, Among place) {
    const std::uint32_t chunk = place.series / sites_at_once<R>, pair = place.index / 2;
    const auto& recent = context.recent[(chunk + kind_of_sites) % recent_series];
    const bool is_there =
        recent.series == chunk && recent.kind == kind_of_sites && recent.chunk == pair;
    if (!is_there) refill_sites(context, chunk, pair);
    return recent.numbers[place.index % 2][place.series % sites_at_once<R>];
}

// Whether several numbers at once become normals sooner.
template <class Normal, class Real>
concept ReplacesSeveral = requires(Real* numbers) {
    Normal::template replace<1>(numbers, std::uint32_t{});
};

// The standard normals of a loop's indices from `first` up to `end`, at most so many that they are
// kept.
template <class Normal, Index count, int n, class R>
[[gnu::noinline]] void refill_normals(Context<Pack<n, R>>& context, std::uint32_t series,
                                      std::uint32_t first, std::uint32_t end) {
    constexpr std::uint32_t most =
        std::min<std::uint32_t>(count, Context<Pack<n, R>>::most_normals);
    auto& recent = context.recent_normals[series % recent_series];
    recent.series = series;
    recent.first = first;
    recent.count = end - first;
    if (recent.count == most && first % 2 == 0)
        make_numbers<most + most % 2>(context, series, first, recent.numbers);
    else
        for (std::uint32_t i = 0; i < recent.count; ++i)
            recent.numbers[i] = uniform_at(context, PlaceAmong<count>(series, first + i));
    Normal::template replace<most>(recent.numbers, recent.count);
}
// Two floats alone are not computed sooner together.
template <class R>
inline constexpr Index least_normals_together = std::is_same_v<R, float> ? 3 : 2;

// A draw of a loop in packs, whose normals are made together with some of its neighbours'.
template <class Normal, int n, class R, Index count>
requires(n > 1 && n <= 16 && count >= least_normals_together<R> &&
         ReplacesSeveral<Normal, Lanes<R, n>>)  //
    RDDL_INLINE Lanes<R, n> standard_at(Context<Pack<n, R>>& context, PlaceAmong<count> place) {
    constexpr std::uint32_t most = Context<Pack<n, R>>::most_normals;
    const auto& recent = context.recent_normals[place.series % recent_series];
    if (!recent.has(place)) {
        const std::uint32_t end = std::min<std::uint32_t>((place.index / most + 1) * most, count);
        refill_normals<Normal, count>(context, place.series, place.index, end);
    }
    return recent.numbers[place.index - recent.first];
}

// A draw of a standard distribution. A single environment also draws the neighbours' numbers, in
// registers, unless the compiler sees that the draw has no neighbours.
template <class Standard, class L, class SomePlace>
RDDL_INLINE typename L::Real standard_at(Context<L>& context, SomePlace place) {
    constexpr bool is_lone =
        std::is_same_v<SomePlace, LonePlace> || std::is_same_v<SomePlace, PlaceAmongSites>;
    if constexpr (L::width == 1 && !is_lone)
        if (!__builtin_constant_p(place.index)) return recent_number<Standard>(context, place);
    return Standard::of(uniform_at(context, place));
}

// Doubles share registers with the tails of neighbours, wanted or not.
template <class Standard, class L, Index count>
requires(std::same_as<typename L::Element, double>) RDDL_INLINE typename L::Real
    standard_at(Context<L>& context, PlaceAmongSome<count> place) {
    return standard_at<Standard>(context, PlaceAmong<count>(place));
}

// The part that all draws of a step of one environment share, for loops that draw in registers.
struct StepDraws {
    template <class R>
    explicit RDDL_INLINE StepDraws(const Context<ScalarOf<R>>& context)
        : schedule(context.step, {context.key.low, context.key.high}),
          are_medians(context.key == median_key) {}

    philox::Schedule<philox::draw_rounds, std::uint64_t> schedule;
    bool are_medians;
};

template <class L, class SomePlace = Place>
RDDL_INLINE typename L::Real open_uniform_at(Context<L>& context, SomePlace place) {
    return open_unit_real(uniform_at(context, place));
}

// -------------------------------------------------------------------- many numbers of a draw

// The random numbers of one draw in one environment, as many as it needs.
class Draws {
  public:
    // Few draws need more than these.
    static constexpr std::uint32_t first_count = 3;

    constexpr Draws(StreamKey key, std::uint32_t step, Place place)
        : step_(step), place_(place), key_{key.low, key.high}, is_median_(key == median_key) {}
    // The first numbers are known.
    constexpr Draws(StreamKey key, std::uint32_t step, Place place,
                    const std::array<double, first_count>& first)
        : Draws(key, step, place) {
        known_ = first_count;
        first_ = first;
    }
    template <class R = double>
    constexpr Draws(const Context<ScalarOf<R>>& context, Place place)
        : Draws(context.key, context.step, place) {}

    constexpr double uniform() {
        if (is_median_) return median_number;
        const std::uint32_t number = number_++;
        if (number < known_) return first_[number];
        if (number == 0) return first();
        if (number % 2 == 0) return second_;
        const philox::Block<std::uint64_t> words = generate(place_.index, 1 + (number - 1) / 2);
        second_ = unit_real<double>(words[2], words[3]);
        return unit_real<double>(words[0], words[1]);
    }
    constexpr double open_uniform() { return open_unit_real(uniform()); }

  private:
    constexpr double first() const {
        const philox::Block<std::uint64_t> words = generate(place_.index / 2, 0);
        return place_.index % 2 == 0 ? unit_real<double>(words[0], words[1])
                                     : unit_real<double>(words[2], words[3]);
    }
    constexpr philox::Block<std::uint64_t> generate(std::uint64_t index,
                                                    std::uint64_t number) const {
        return philox::generate<philox::draw_rounds>(
            philox::Block<std::uint64_t>{step_, place_.series, index, number}, key_);
    }

    std::uint64_t step_;
    Place place_;
    philox::Key<std::uint64_t> key_;
    bool is_median_;
    std::uint32_t number_ = 0;
    double second_ = 0;  // of the counter value used last
    std::uint32_t known_ = 0;
    std::array<double, first_count> first_{};
};

// The first numbers of a draw in all lanes, made in registers.
template <int n>
struct FirstDraws {
    Lanes<double, n> numbers[Draws::first_count];

    std::array<double, Draws::first_count> of(int lane) const {
        return {numbers[0][lane], numbers[1][lane], numbers[2][lane]};
    }
};
template <int n, class R>
[[gnu::noinline]] FirstDraws<n> first_draws(const Context<Pack<n, R>>& context, Place place) {
    using Word = Lanes<std::uint64_t, n>;
    const auto generate = [&](std::uint64_t index, std::uint64_t number) {
        return philox::generate<philox::draw_rounds>(
            philox::Block<Word>{context.step, Word{std::uint64_t{place.series}}, Word{index},
                                Word{number}},
            {context.key_low, context.key_high});
    };
    const philox::Block<Word> shared = generate(place.index / 2, 0), own = generate(place.index, 1);
    const std::size_t half = 2 * (place.index % 2);
    return {{unit_real<double>(shared[half], shared[half + 1]), unit_real<double>(own[0], own[1]),
             unit_real<double>(own[2], own[3])}};
}

// An int, or the lane type's real instead of double.
template <class L, class T>
using DrawnBy = std::conditional_t<std::is_floating_point_v<T>, typename L::Element, T>;

// Draws that need more than one number: `kernel(draws, parameters...)`, which draws ints or
// doubles, in each lane whose parameters are valid, zero elsewhere.
template <class R, class Kernel, class... Parameters>
constexpr auto draw_in_each_lane(const Context<ScalarOf<R>>& context, Place place, bool valid,
                                 Kernel kernel, Parameters... parameters) {
    Draws draws(context, place);
    using Result = DrawnBy<ScalarOf<R>, decltype(kernel(draws, parameters...))>;
    return valid ? static_cast<Result>(kernel(draws, parameters...)) : Result{};
}
template <int n, class R, class Kernel, class... Parameters>
auto draw_in_each_lane(const Context<Pack<n, R>>& context, Place place, Mask<n> valid,
                       Kernel kernel, Parameters... parameters) {
    using Drawn = decltype(kernel(std::declval<Draws&>(), parameters[0]...));
    using Result = DrawnBy<Pack<n, R>, Drawn>;
    LanesOf<Result, n> results{Result{}};
    const Mask<n> drawing = valid && context.active;
    if (!any(drawing)) return results;
    const FirstDraws<n> first = first_draws(context, place);
    for_each_lane(drawing, [&](int lane) {
        Draws draws(context.key(lane), static_cast<std::uint32_t>(context.step[lane]), place,
                    first.of(lane));
        results.set(lane, static_cast<Result>(kernel(draws, parameters[lane]...)));
    });
    return results;
}

// Rejection loops end after this many attempts. A loop that accepts once in two attempts gets
// here with probability 1e-301, so only parameters like nan or infinity do.
inline constexpr int rejection_limit = 1000;

}  // namespace rddl
