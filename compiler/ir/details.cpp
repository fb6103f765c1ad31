#include "ir/details.hpp"

#include "ir/layout.hpp"

namespace rddlc::ir {

std::size_t interm_size(const Details& details) {
    const RecordLayout layout = record_layout(details.program, Storage::Observation);
    for (const Field& field : layout.fields)
        if (!details.program[field.buffer].fluent) return field.offset;
    return layout.size;
}

}  // namespace rddlc::ir
