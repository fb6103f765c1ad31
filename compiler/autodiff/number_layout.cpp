#include "autodiff/number_layout.hpp"

#include "ir/layout.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace rddlc::autodiff {

NumberLayout::NumberLayout(const ir::Program& program, ir::Storage storage) {
    const ir::RecordLayout layout = ir::record_layout(program, storage);
    record_size_ = layout.size;
    for (const ir::Field& field : layout.fields) {
        const ir::Buffer& buffer = program[field.buffer];
        const std::size_t size = ir::size_of(buffer.scalar);
        for (std::size_t i = 0; i < static_cast<std::size_t>(buffer.count()); ++i)
            entries_.push_back({buffer.scalar, field.offset + i * size});
    }
}

double NumberLayout::read(const std::byte* record, std::size_t number) const {
    const Entry& entry = entries_[number];
    const std::byte* const from = record + entry.offset;
    if (entry.scalar == ir::Scalar::Bool) return *from != std::byte{0} ? 1.0 : 0.0;
    if (entry.scalar == ir::Scalar::Int) {
        std::int64_t value;
        std::memcpy(&value, from, sizeof value);
        return static_cast<double>(value);
    }
    double value;
    std::memcpy(&value, from, sizeof value);
    return value;
}

void NumberLayout::write(double value, std::byte* record, std::size_t number) const {
    const Entry& entry = entries_[number];
    std::byte* const to = record + entry.offset;
    if (entry.scalar == ir::Scalar::Bool) {
        *to = std::byte(value > 0.5);
    } else if (entry.scalar == ir::Scalar::Int) {
        const auto whole = static_cast<std::int64_t>(std::nearbyint(value));
        std::memcpy(to, &whole, sizeof whole);
    } else {
        std::memcpy(to, &value, sizeof value);
    }
}

}  // namespace rddlc::autodiff
