// The logistic function.
#pragma once

#include <cmath>

namespace rddlc {

inline double sigmoid(double x) {
    return 1 / (1 + std::exp(-x));
}

}  // namespace rddlc
