// Rules that the searches of plan:uct share.
#pragma once

#include "planners/uct/uct_options.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace rddlc::planners {

// An action is not chosen in the end if it was tried less than this part of the one tried most.
inline constexpr double least_tried = 0.2;

// How much what was tried less counts, in ranges of the returns, unless the user says so. Where
// priors and values are those of networks, that is the constant of MuZero (Schrittwieser and
// others, 2020), whose values lie between 0 and 1.
inline constexpr double usual_exploration = 0.5, exploration_by_values = 1.25;

// The depth of trees, if the user gives none.
inline constexpr std::int64_t usual_depth = 40;

// The step up to which a search looks ahead, `depth` steps at most, where `left` remain and the
// tree of the decision before looked ahead to `known_end`: to the same, if that is far enough
// ahead.
inline std::int64_t end_of_search(std::int64_t step, std::int64_t left, std::int64_t depth,
                                  std::int64_t known_end) {
    if (left <= depth) return step + left;
    return known_end >= step + (depth + 1) / 2 ? std::min(known_end, step + depth) : step + depth;
}

// How far apart returns may be, by the least and the greatest that were seen. Where all that was
// tried costs about the same, as courses before the first one is passed, better ones may remain.
inline double range_of_returns(double least, double most) {
    constexpr double least_part = 0.02;
    if (!(most >= least)) return 0;
    return std::max(most - least, least_part * std::max(std::abs(least), std::abs(most)));
}

// sqrt(log(1 + n)), as UCB1 has it for a node of n trials, to three digits: the first 8 bits of
// 1 + n count.
inline double root_of_logarithm(std::int32_t trials) {
    constexpr int bits_of_float = 23, bits = 7;  // after the first one
    constexpr std::uint32_t first = std::bit_cast<std::uint32_t>(1.0f) >> (bits_of_float - bits);
    static const auto known = [] {
        std::array<float, (std::size_t{32} << bits)> roots;
        for (std::uint32_t k = 0; k < roots.size(); ++k)
            roots[k] =
                std::sqrt(std::log(std::bit_cast<float>((first + k) << (bits_of_float - bits))));
        return roots;
    }();
    const auto number = std::bit_cast<std::uint32_t>(static_cast<float>(trials) + 1.0f);
    return static_cast<double>(known[(number >> (bits_of_float - bits)) - first]);
}

// Whether an action that was taken so often has as many outcomes as may be told apart.
inline bool has_all_outcomes(const UctOptions& options, double taken, double outcomes) {
    return options.outcomes > 0 && outcomes >= std::ceil(options.outcomes * std::sqrt(taken));
}

}  // namespace rddlc::planners
