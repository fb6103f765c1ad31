// What the text of a simulator of 64 lanes uses, for each compiler that users may have: it must
// compile.
#include <rddl/values/bool_rows.hpp>

#include <array>

template void rddl::bit_matrix::store_masks<64>(const std::array<rddl::bit_matrix::BitColumns, 8>&,
                                                int, rddl::Mask<64>*);
