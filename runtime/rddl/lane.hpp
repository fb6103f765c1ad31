// Lane types: what one evaluation of the emitted code works on.
//
// Emitted code and kernels are generic over a lane type L, which names the types of values. Scalar
// is one environment. A pack of environments would be another lane type with the same names.
#pragma once

#include <cstdint>

namespace rddl {

struct Scalar {
    static constexpr int width = 1;
    using Bool = bool;
    using Int = std::int64_t;
    using Real = double;
};

// A loop index: the same in every lane.
using Index = std::int64_t;

}  // namespace rddl
