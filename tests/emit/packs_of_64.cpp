// Each compiler that users may have must compile what simulators of 64 lanes use.
#include <rddl/values/bool_rows.hpp>

#include <array>

template void rddl::bit_matrix::store_masks<64>(const std::array<rddl::bit_matrix::BitColumns, 8>&,
                                                int, rddl::Mask<64>*);
