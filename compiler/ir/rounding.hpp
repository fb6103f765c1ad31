// Other last digits: how far apart two right answers may be where values cancel.
//
// Monte Carlo arithmetic (D. S. Parker, 1997), of the differences between right implementations
// alone: results of elementary functions, and sums and products, whose order is free. Operators
// that IEEE rounds, and sums that are exact, stay as they are, and so do comparisons of exact
// values.
#pragma once

#include "vocabulary/vocabulary.hpp"

#include <cstdint>
#include <random>

namespace rddlc::ir {

class Rounding {
  public:
    explicit Rounding(std::uint64_t seed) : random_(seed) {}

    // A result that another library may give for this operator on reals.
    double of_function(Operator op, double result);
    // A result that adding or multiplying in another order may give.
    double sum(double a, double b);
    double product(double a, double b);

  private:
    // Within the error that is expected of a number of this size.
    double error(double size, double relative);

    std::mt19937_64 random_;
};

}  // namespace rddlc::ir
