// The random numbers of draws that every step of one environment makes, made together.
//
// The rounds of Philox wait for each other, so several registers of counters take hardly longer
// than one. A row of four counters has the numbers of a loop over up to 8 objects, or of up to
// four draws that a step makes once. Packs, and processors without half registers of AVX-512, make
// the numbers where they are used.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/object_lanes/objects.hpp>
#include <rddl/random/random.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/few_words.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace rddl {

// The series and the pairs of neighbouring indices of four counters.
struct FourCounters {
    std::array<std::uint64_t, 4> series, pairs;
};

// The counters of a loop over up to 8 objects, and of draws that are made once.
constexpr FourCounters counters_of_loop(std::uint64_t series) {
    return {{series, series, series, series}, {0, 1, 2, 3}};
}
template <std::size_t count>
constexpr FourCounters counters_of_draws(const Place (&places)[count]) {
    FourCounters counters{};
    for (std::size_t i = 0; i < count; ++i) {
        counters.series[i] = places[i].series;
        counters.pairs[i] = places[i].index / 2;
    }
    return counters;
}

inline namespace RDDL_SIMD_LEVEL {

// The place of the draws of a loop, whose numbers are known.
struct PlaceOfRow : Place {
    const FewWords& even;
    const FewWords& odd;
};
// The place of a draw that a step makes once, whose number is known.
struct PlaceOfNumber : Place {
    std::uint64_t number;
};

template <class L, const auto& rows>
struct StepNumbers {
    explicit RDDL_INLINE StepNumbers(const Context<L>&) {}

    template <std::size_t>
    RDDL_INLINE Place of_row(Place place) const {
        return place;
    }
    template <std::size_t, std::size_t>
    RDDL_INLINE LonePlace of_lane(LonePlace place) const {
        return place;
    }
};

#ifdef RDDL_SIMD_AVX512

template <class R, const auto& rows>
struct StepNumbers<ScalarOf<R>, rows> {
    static constexpr std::size_t count = rows.size();
    FewWords even[count], odd[count];

    explicit RDDL_INLINE StepNumbers(const Context<ScalarOf<R>>& context) {
        const StepDraws draws(context);
        [&]<std::size_t... row>(std::index_sequence<row...>) RDDL_INLINE_LAMBDA {
            philox::Block<FewWords> words[count];
            draws.schedule.generate({FewWords::load(rows[row].series.data())...},
                                    {FewWords::load(rows[row].pairs.data())...}, words);
            ((even[row] = join_lower_halves(words[row][0], words[row][1])), ...);
            ((odd[row] = join_lower_halves(words[row][2], words[row][3])), ...);
        }
        (std::make_index_sequence<count>());
        if (draws.are_medians) [[unlikely]]
            for (std::size_t row = 0; row < count; ++row)
                even[row] = odd[row] = FewWords(std::uint64_t{1} << 63);
    }

    template <std::size_t row>
    RDDL_INLINE PlaceOfRow of_row(Place place) const {
        return {place, even[row], odd[row]};
    }
    template <std::size_t row, std::size_t lane>
    RDDL_INLINE PlaceOfNumber of_lane(Place place) const {
        return {place, (place.index % 2 == 0 ? even : odd)[row].part[lane]};
    }
};

#endif

}  // namespace RDDL_SIMD_LEVEL

// The place of a site's draws in a loop, and of one that a step makes once; perhaps with the series
// of another site.
template <std::size_t row, class Numbers, class Object>
RDDL_INLINE auto place_in_row(const Numbers& numbers, std::uint32_t site, const Object& object,
                              std::uint32_t series) {
    return numbers.template of_row<row>({site, object, series});
}
template <std::size_t row, class Numbers, class Object>
RDDL_INLINE auto place_in_row(const Numbers& numbers, std::uint32_t site, const Object& object) {
    return place_in_row<row>(numbers, site, object, site);
}
template <std::size_t row, std::size_t lane, class Numbers>
RDDL_INLINE auto place_in_lane(const Numbers& numbers, std::uint32_t site, Index index,
                               std::uint32_t series) {
    return numbers.template of_lane<row, lane>({site, index, series});
}
template <std::size_t row, std::size_t lane, class Numbers>
RDDL_INLINE auto place_in_lane(const Numbers& numbers, std::uint32_t site, Index index) {
    return place_in_lane<row, lane>(numbers, site, index, site);
}

template <int n, class R>
requires(n <= 8)  //
    RDDL_INLINE Lanes<R, n> uniform_at(Context<Objects<n, R>>&, const PlaceOfRow& place) {
    return part_of<Lanes<R, n>>(unit_real<R>(interleaved(place.even, place.odd)), 0);
}
template <class R>
RDDL_INLINE R uniform_at(Context<ScalarOf<R>>&, const PlaceOfRow& place) {
    const FewWords& numbers = place.index % 2 == 0 ? place.even : place.odd;
    return unit_real<R>(numbers.part[place.index / 2]);
}
template <class R>
RDDL_INLINE R uniform_at(Context<ScalarOf<R>>&, const PlaceOfNumber& place) {
    return unit_real<R>(place.number);
}

}  // namespace rddl
