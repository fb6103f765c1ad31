// Intervals: within which a value lies for certain. They tell which draws cannot fault.
#pragma once

#include "model/vocabulary.hpp"

#include <optional>
#include <span>

namespace rddlc::ir {

// Closed, without nan; bounds may be infinite. Rounding is monotone, so the bounds of a sum are
// the rounded sums of the bounds.
struct Range {
    double lower, upper;
    bool operator==(const Range&) const = default;
};

// Ints of a smaller magnitude are doubles exactly.
inline constexpr double exact_ints = 0x1p53;

Range join(Range a, Range b);

// The range of `op` on reals, where it is known.
std::optional<Range> range_of(Operator op, std::span<const std::optional<Range>> operands);

// Finite operands from these ranges give a finite result, unless a sum or product overflows. A
// quotient by 1e-30 or more, and a power up to 16, count as products.
bool keeps_finite(Operator op, std::span<const std::optional<Range>> operands);

// Finite parameters from these ranges give a finite draw, unless a sum or product overflows: tails
// may be so heavy that they reach beyond all reals.
bool draws_finite(Distribution distribution, std::span<const std::optional<Range>> parameters);

// True if parameters from these ranges are always in the distribution's domain: it cannot fault.
bool always_in_domain(Distribution distribution, std::span<const std::optional<Range>> parameters);

}  // namespace rddlc::ir
