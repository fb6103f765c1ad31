#include "ir/layout.hpp"

#include <algorithm>

namespace rddlc::ir {
namespace {

std::size_t round_up(std::size_t size, std::size_t alignment) {
    return (size + alignment - 1) / alignment * alignment;
}

}  // namespace

std::size_t size_of(Scalar scalar) {
    return scalar == Scalar::Bool ? 1 : 8;
}

RecordLayout record_layout(const Program& program, Storage storage) {
    RecordLayout layout;
    std::size_t alignment = 1;
    for (std::uint32_t index = 0; index < program.buffers.size(); ++index) {
        const Buffer& buffer = program.buffers[index];
        if (buffer.storage != storage) continue;
        const std::size_t element = size_of(buffer.scalar);
        const std::size_t offset = round_up(layout.size, element);
        layout.fields.push_back({BufferId{index}, offset});
        layout.size = offset + element * static_cast<std::size_t>(buffer.count());
        alignment = std::max(alignment, element);
    }
    layout.size = round_up(layout.size, alignment);
    return layout;
}

}  // namespace rddlc::ir
