// The place of each buffer in its record: plain C struct rules, fluents in declaration order.
#pragma once

#include "ir/ir.hpp"

#include <cstddef>
#include <vector>

namespace rddlc::ir {

// Bytes of one element: bool 1, int 8, real 8; also its alignment.
std::size_t size_of(Scalar scalar);

struct Field {
    BufferId buffer;
    std::size_t offset;  // bytes from the start of the record
};

struct RecordLayout {
    std::vector<Field> fields;  // in the order of Program::buffers
    std::size_t size = 0;       // bytes, a multiple of the alignment; 0 for a record without fields
};

// The record of all buffers of one storage. State and Next have the same layout.
RecordLayout record_layout(const Program& program, Storage storage);

}  // namespace rddlc::ir
