// The context of an evaluation: the random stream of the episode, the step, the first fault.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/lanes/pack.hpp>
#include <rddl/values/philox.hpp>

#include <array>
#include <cstdint>
#include <type_traits>

namespace rddl {

// The place of a draw or a possible fault: a site of the program text, and the row-major index into
// the objects of the site's scope. `series` is the site whose random numbers a draw has: its own,
// or, if only one of several is evaluated, that of the first one.
struct Place {
    std::uint32_t site = 0;
    std::uint32_t index = 0;
    std::uint32_t series = 0;

    constexpr Place() = default;
    constexpr Place(std::uint32_t its_site, Index index_in_scope)
        : Place(its_site, index_in_scope, its_site) {}
    constexpr Place(std::uint32_t its_site, Index index_in_scope, std::uint32_t its_series)
        : site(its_site), index(static_cast<std::uint32_t>(index_in_scope)), series(its_series) {}
    constexpr bool operator==(const Place&) const = default;
};

// The place of a draw that a step makes once: numbers are not made for its neighbours as well.
struct LonePlace : Place {
    using Place::Place;
};

// The same for one of many such draws: those of neighbouring sites are most likely wanted as
// well.
struct PlaceAmongSites : Place {
    using Place::Place;
};

// The place of one of `count` draws that a loop makes: its neighbours' numbers are most likely
// wanted as well.
template <Index count>
struct PlaceAmong : Place {
    using Place::Place;
};

// The same where a table chooses the objects that draw: normal floats are then made for each alone.
template <Index count>
struct PlaceAmongSome : PlaceAmong<count> {
    using PlaceAmong<count>::PlaceAmong;
};

// The key of an episode's random stream (random.hpp).
struct StreamKey {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    constexpr bool operator==(const StreamKey&) const = default;
};
// The key of a stream in which nothing is random: each uniform number is 1/2. So draws are the
// medians of their distributions where one number decides them: a Bernoulli draw is its likelier
// value, a normal one its mean, up to rounding. An episode has this key by chance once in 2^64.
inline constexpr StreamKey median_key{~std::uint32_t{0}, ~std::uint32_t{0}};

// The kind of a fault; sites.hpp says it in words.
enum class FaultKind : std::uint8_t {
    None,
    Type,                 // a value of the wrong type; the site's text is the message
    NegativeExponent,     // int ^ negative int
    GammaArgument,        // gamma, lngamma of a number that is not > 0
    Probability,          // not in [0, 1]
    PositiveProbability,  // not in (0, 1]
    Width,                // upper minus lower bound: negative, infinite or nan
    Variance,             // not >= 0
    Rate,                 // not in [0, 9.2e18]
    Mean,                 // this and the next three: not > 0
    Shape,
    Scale,
    DegreesOfFreedom,
    Trials,          // negative
    Successes,       // not > 0
    Weight,          // not >= 0
    ProbabilitySum,  // not 1
    WeightSum,       // not > 0, or infinite
    CountTooLarge,   // a draw beyond the range of int
    PositiveWeight,  // not > 0
    Covariance,      // not positive definite
    Undefined,       // no value; the site's text is the message
    ActionLimit,     // a policy's action with more than max-nondef-actions changed values
};

struct FaultRecord {
    FaultKind kind = FaultKind::None;
    Place place;
    double value = 0;  // the offending one

    constexpr explicit operator bool() const { return kind != FaultKind::None; }
};

template <class L>
struct Context;

// No draw has this series.
inline constexpr std::uint32_t no_series = ~std::uint32_t{0};

// The numbers made last for one of the series that a step draws from, so that those of one loop do
// not drive each other out. A power of two.
inline constexpr std::uint32_t recent_series = 4;

template <class R>
struct Context<ScalarOf<R>> {
    StreamKey key;
    std::uint32_t step = 0;  // 0 at reset; the step that leaves timestep t has t + 1
    FaultRecord fault{};

    // The recent numbers of one series and step and pairs of neighbouring indices, the even ones
    // first; uniform or of another kind (random.hpp).
    static constexpr int most_pairs = 8;
    struct Recent {
        std::uint32_t series = no_series;
        std::uint32_t kind;
        std::uint32_t chunk;
        alignas(most_pairs * sizeof(R)) R numbers[2][most_pairs];
        constexpr Recent() {}  // leaves the numbers as they are, to be quick
    };
    std::array<Recent, recent_series> recent{};

    static constexpr Context of(std::uint64_t key_low, std::uint64_t key_high, std::uint64_t step,
                                bool /*active*/) {
        return {{static_cast<std::uint32_t>(key_low), static_cast<std::uint32_t>(key_high)},
                static_cast<std::uint32_t>(step),
                {},
                {}};
    }

    constexpr void go_to_next_step() {
        ++step;
        for (Recent& numbers : recent) numbers.series = no_series;
    }

    constexpr bool faulted() const { return static_cast<bool>(fault); }
    constexpr const FaultRecord& fault_of(int /*lane*/) const { return fault; }

    // Passes `ok` on, having recorded a fault where it is false. The first fault wins.
    constexpr bool require(bool ok, FaultKind kind, Place place, double value) {
        if (!ok && !fault) fault = {kind, place, value};
        return ok;
    }
};

template <int n, class R>
struct Context<Pack<n, R>> {
    using Word = Lanes<std::uint64_t, n>;

    Word key_low, key_high;
    Word step;
    Mask<n> active;  // the lanes whose values are used: they alone can fault
    Mask<n> faulty{false};
    std::array<FaultRecord, static_cast<std::size_t>(n)> faults;  // of the faulty lanes

    // The recent numbers of one series and step, and the indices from `first` on.
    static constexpr std::uint32_t most_numbers = 4;
    template <std::uint32_t most>
    struct Recent {
        std::uint32_t series = no_series;
        std::uint32_t first, count;
        Lanes<R, n> numbers[most];

        RDDL_INLINE bool has(Place place) const {
            return series == place.series && place.index - first < count;
        }
    };
    std::array<Recent<most_numbers>, recent_series> recent;
    // Standard ones. Floats keep more of them, so that fewer are computed alone.
    static constexpr std::uint32_t most_normals = std::is_same_v<R, float> ? 8 : most_numbers;
    std::array<Recent<most_normals>, recent_series> recent_normals;

    // The schedule of all draws of the step, where registers have room for that of all lanes; the
    // first draw makes it.
    struct NoSchedule {};
    static constexpr bool keeps_schedule = n <= 16;
    std::conditional_t<keeps_schedule, philox::Schedule<philox::draw_rounds, Word>, NoSchedule>
        schedule;
    Mask<n> draws_medians;  // the lanes whose key is median_key
    bool is_scheduled = false;

    static Context of(const Word& key_low, const Word& key_high, const Word& step, Mask<n> active) {
        Context context;
        context.key_low = key_low;
        context.key_high = key_high;
        context.step = step;
        context.active = active;
        return context;
    }

    Mask<n> faulted() const { return faulty; }
    const FaultRecord& fault_of(int lane) const { return faults[static_cast<std::size_t>(lane)]; }

    StreamKey key(int lane) const {
        return {static_cast<std::uint32_t>(key_low[lane]),
                static_cast<std::uint32_t>(key_high[lane])};
    }

    // `value` is a number, the same in all lanes or one in each.
    template <class Value>
    RDDL_INLINE Mask<n> require(Mask<n> ok, FaultKind kind, Place place, const Value& value) {
        if (any(active && !ok)) record(active && !ok, kind, place, value);
        return ok;
    }

  private:
    template <class Value>
    [[gnu::noinline, gnu::cold]] void record(Mask<n> failed, FaultKind kind, Place place,
                                             const Value& value) {
        for_each_lane(failed && !faulty, [&](int lane) {
            faults[static_cast<std::size_t>(lane)] = {kind, place, get_lane(value, lane)};
        });
        faulty = faulty || failed;
    }
};

template <class R>
struct Context<ByteIntPack<R>> : Context<Pack<64, R>> {
    using typename Context<Pack<64, R>>::Word;
    static Context of(const Word& key_low, const Word& key_high, const Word& step,
                      Mask<64> active) {
        return {Context<Pack<64, R>>::of(key_low, key_high, step, active)};
    }
};

// A fault that has no value to show; evaluates to zero.
template <class T, class L>
constexpr T fault(Context<L>& context, Place place) {
    context.require(false, FaultKind::Type, place, 0.0);
    return T{};
}

}  // namespace rddl
