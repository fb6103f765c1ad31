// The standard normals of several loops over objects, made together before a step of one
// environment.
//
// One of seven is far from the median and takes several times as long as the others. The far ones
// of all loops share registers. Packs, and floats, make them where they are used.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/object_lanes/objects.hpp>
#include <rddl/random/distributions/continuous.hpp>
#include <rddl/random/random.hpp>
#include <rddl/values/context.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace rddl {

// A loop that draws normals, each object one.
struct LoopOfNormals {
    std::uint32_t series;
    Index count;
};

namespace detail {

// Half of the normals: a counter value has the numbers of two neighbours.
template <std::size_t loops>
constexpr std::size_t pairs_before(const std::array<LoopOfNormals, loops>& all, std::size_t loop) {
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < loop; ++i) pairs += static_cast<std::size_t>(all[i].count + 1) / 2;
    return pairs;
}

}  // namespace detail

inline namespace RDDL_SIMD_LEVEL {

// The place of the normals of a loop, which are known.
struct PlaceOfNormals : Place {
    const double* of_loop;
};

template <class L, const auto& loops>
struct StepNormals {
    explicit RDDL_INLINE StepNormals(const Context<L>&) {}

    template <std::size_t, class SomePlace>
    RDDL_INLINE SomePlace of_loop(SomePlace place) const {
        return place;
    }
};

template <const auto& loops>
struct StepNormals<ScalarOf<double>, loops> {
    explicit RDDL_INLINE StepNormals(const Context<ScalarOf<double>>& context) {
        make(StepDraws(context));
    }

    template <std::size_t loop>
    RDDL_INLINE PlaceOfNormals of_loop(Place place) const {
        constexpr std::size_t first = 2 * detail::pairs_before(loops, loop);
        return {place, normals_ + first};
    }

  private:
    using Numbers = Lanes<double, objects_at_once>;
    using Words = Lanes<std::uint64_t, objects_at_once / 2>;
    static constexpr std::size_t registers =
        (detail::pairs_before(loops, loops.size()) + Words::width - 1) / Words::width;
    struct Counters {
        std::uint64_t series[registers * Words::width], pairs[registers * Words::width];
    };
    static constexpr Counters counters = [] {
        Counters all{};
        std::size_t at = 0;
        for (const LoopOfNormals& loop : loops)
            for (Index object = 0; object < loop.count; object += 2, ++at) {
                all.series[at] = loop.series;
                all.pairs[at] = static_cast<std::uint64_t>(object / 2);
            }
        return all;
    }();

    [[gnu::noinline]] void make(const StepDraws& draws) {
        constexpr std::size_t in_turns = registers < 2 ? 1 : 2;
        Numbers numbers[registers];
        std::size_t at = 0;
        for (; at + in_turns <= registers; at += in_turns)
            draw<in_turns>(draws.schedule, at, numbers + at);
        if (at < registers) draw<1>(draws.schedule, at, numbers + at);
        if (draws.are_medians) [[unlikely]]
            for (Numbers& each : numbers) each = Numbers{median_number};
        StandardNormal::replace<registers>(numbers, registers);
        for (std::size_t i = 0; i < registers; ++i) numbers[i].store(normals_ + i * Numbers::width);
    }
    // The numbers of so many registers of counters.
    template <std::size_t count, class Schedule>
    static RDDL_INLINE void draw(const Schedule& schedule, std::size_t first, Numbers* numbers) {
        Words series[count], pairs[count];
        philox::Block<Words> words[count];
        for (std::size_t i = 0; i < count; ++i) {
            series[i] = Words::load(counters.series + (first + i) * Words::width);
            pairs[i] = Words::load(counters.pairs + (first + i) * Words::width);
        }
        schedule.generate(series, pairs, words);
        for (std::size_t i = 0; i < count; ++i)
            numbers[i] =
                unit_real<double>(interleaved(join_lower_halves(words[i][0], words[i][1]),
                                              join_lower_halves(words[i][2], words[i][3])));
    }

    // Behind the last ones there is room for lanes without an object.
    double normals_[(registers + 1) * Numbers::width];
};

}  // namespace RDDL_SIMD_LEVEL

// The place of a draw in a loop whose normals are made before the step.
template <std::size_t loop, class Normals, class SomePlace>
RDDL_INLINE auto place_of_normals(const Normals& normals, SomePlace place) {
    return normals.template of_loop<loop>(place);
}

template <class Normal, int n>
RDDL_INLINE Lanes<double, n> standard_at(Context<Objects<n, double>>&, PlaceOfNormals place) {
    return Lanes<double, n>::load(place.of_loop + place.index);
}

}  // namespace rddl
