// Intervals: within which a value lies for certain. They show which draws cannot fault, and which
// numbers are finite.
#pragma once

#include "vocabulary/vocabulary.hpp"

#include <initializer_list>
#include <optional>
#include <span>

namespace rddlc {

// Closed, without nan; bounds may be infinite. Rounding is monotone, so the bounds of a sum are
// the rounded sums of the bounds.
struct Range {
    double lower, upper;
    bool operator==(const Range&) const = default;
};

// Ints of a smaller magnitude are doubles exactly.
inline constexpr double exact_ints = 0x1p53;

Range join(Range a, Range b);

// A number beyond all floats is not finite, since simulators may compute with them (--real=float).
bool is_finite(const Range& range);
// Whether it is known that a number is not zero. One that is smaller than all floats counts as zero
// for the same reason.
bool excludes_zero(const std::optional<Range>& range);

// The range of `op` on reals, where it is known. Functions of the runtime may be off by some last
// digits, which the range allows for.
std::optional<Range> range_of(Operator op, std::span<const std::optional<Range>> operands);

// The range of a real draw with parameters from these ranges, where it is known. The uniform number
// behind a draw is at least 2^-53 from 0 and from 1; -ln of that is 37.
std::optional<Range> range_of(Distribution distribution,
                              std::span<const std::optional<Range>> parameters);

// The range of a sum or product of at most so many reals from this range, the empty one included.
Range range_of_sum(const Range& term, double count);
Range range_of_product(const Range& factor, double count);

// True if parameters from these ranges are always in the distribution's domain: it cannot fault.
bool always_in_domain(Distribution distribution, std::span<const std::optional<Range>> parameters);

// ---------------------------------------------------------------------------- for the tables

// A row's range for one or two operands or parameters, whose ranges are finite.
using RangeRule = std::optional<Range> (*)(Range first, Range last);

// The smallest range that holds all corners; nothing if one of them is nan.
std::optional<Range> hull(std::initializer_list<double> corners);
double magnitude(Range range);
Range symmetric(double magnitude);
// The range with a margin for the rounding of functions and long sums.
Range padded(Range range);
// Nothing if there is no rule, or if an operand's range is unknown or not finite.
std::optional<Range> apply(RangeRule rule, std::span<const std::optional<Range>> operands);

}  // namespace rddlc
