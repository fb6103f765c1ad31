// The external function of problem.rddl.
#pragma once

namespace rddl_extern {

inline double worth(double water, bool pumps) {
    return water - 0.5 * (pumps ? 1.0 : 0.0);
}

}  // namespace rddl_extern
