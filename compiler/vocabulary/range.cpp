#include "vocabulary/range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rddlc {

std::optional<Range> hull(std::initializer_list<double> corners) {
    for (double corner : corners) {
        if (std::isnan(corner)) return std::nullopt;
    }
    return Range{std::min(corners), std::max(corners)};
}

double magnitude(Range range) {
    return std::max(std::abs(range.lower), std::abs(range.upper));
}

Range symmetric(double magnitude) {
    return {-magnitude, magnitude};
}

Range padded(Range range) {
    const double slack = 1e-9 * magnitude(range);
    return {range.lower >= 0 ? std::max(0.0, range.lower - slack) : range.lower - slack,
            range.upper <= 0 ? std::min(0.0, range.upper + slack) : range.upper + slack};
}

std::optional<Range> apply(RangeRule rule, std::span<const std::optional<Range>> operands) {
    for (const std::optional<Range>& operand : operands) {
        if (!operand || !is_finite(*operand)) return std::nullopt;
    }
    return rule ? rule(*operands.front(), *operands.back()) : std::nullopt;
}

Range join(Range a, Range b) {
    return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)};
}

bool is_finite(const Range& range) {
    return magnitude(range) <= std::numeric_limits<float>::max();
}

bool excludes_zero(const std::optional<Range>& range) {
    constexpr double least = std::numeric_limits<float>::denorm_min();
    return range && (range->lower >= least || range->upper <= -least);
}

Range range_of_sum(const Range& term, double count) {
    const auto total = [&](double bound) {
        return bound == 0 ? 0.0 : bound * count;
    };
    return padded({std::min(0.0, total(term.lower)), std::max(0.0, total(term.upper))});
}

Range range_of_product(const Range& factor, double count) {
    const double most = std::pow(std::max(1.0, magnitude(factor)), count);
    return padded(factor.lower >= 0 ? Range{0, most} : symmetric(most));
}

}  // namespace rddlc
