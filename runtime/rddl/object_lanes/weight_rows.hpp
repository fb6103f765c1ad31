// Draws from weights that lie beside each other in a table, which one environment has in the lanes
// of a register. Packs and other processors add one weight after the other
// (rddl/random/distributions/discrete.hpp).
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/lanes/pack.hpp>
#include <rddl/lanes/simd.hpp>
#include <rddl/lanes/simd_moves.hpp>
#include <rddl/object_lanes/step_numbers.hpp>
#include <rddl/random/distributions.hpp>
#include <rddl/random/random.hpp>
#include <rddl/values/context.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#ifdef RDDL_SIMD_AVX512

namespace rddl {
inline namespace RDDL_SIMD_LEVEL {

// A uniform number in all lanes. The numbers of a row lie in a register already.
template <class SomePlace>
RDDL_ALWAYS_INLINE simd::Reals uniform_in_all_lanes(Context<ScalarOf<double>>& context,
                                                    SomePlace place) {
    return simd::Reals{} + uniform_at(context, place);
}
RDDL_ALWAYS_INLINE simd::Reals uniform_in_all_lanes(Context<ScalarOf<double>>&,
                                                    const PlaceOfRow& place) {
    const auto numbers = unit_real<double>(interleaved(place.even, place.odd));
    return simd::in_all_lanes(numbers.part[0], static_cast<int>(place.index));
}

}  // namespace RDDL_SIMD_LEVEL

namespace sample {

// The sums round otherwise than those of one weight after the other, which the margin allows for.
template <std::size_t n, class SomePlace>
requires(n <= static_cast<std::size_t>(simd::lanes))  //
    RDDL_ALWAYS_INLINE std::int64_t
    discrete_of_row(Context<ScalarOf<double>>& context, SomePlace place,
                    const std::array<double, n>& weights) {
    using simd::Reals;
    const Reals sums = simd::running_sums(simd::load_some(weights.data(), static_cast<int>(n)));
    const Reals total = simd::in_all_lanes(sums, simd::lanes - 1);
    const Reals limit = uniform_in_all_lanes(context, place) * total;
    const Reals rounding = total * detail::rounding_of_shares<double>(n);
    const auto chosen = simd::less_equal(sums, limit - rounding);
    const auto above = simd::less(limit + rounding, sums);
    // Each sum is on one side; with an infinite total or a nan, on none.
    constexpr auto all = simd::MaskBits{(1 << simd::lanes) - 1};
    if ((chosen | above) == all && total[0] > detail::least_total<double>) [[likely]]
        return std::popcount(chosen);
    return detail::discrete_of_quotients(context, place, weights);
}

}  // namespace sample
}  // namespace rddl

#endif
