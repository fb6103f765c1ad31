#include "ir/ir.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

namespace rddlc {

std::string_view name_of(RealType real) {
    return real == RealType::Float ? "float" : "double";
}

}  // namespace rddlc

namespace rddlc::ir {

std::int64_t Buffer::row_size(std::size_t leading) const {
    return std::accumulate(shape.begin() + static_cast<std::ptrdiff_t>(leading), shape.end(),
                           std::int64_t{1}, std::multiplies<>());
}

std::int64_t Buffer::count() const {
    return row_size(0);
}

bool Program::partially_observed() const {
    return std::ranges::any_of(
        buffers, [](const Buffer& buffer) { return buffer.storage == Storage::Observation; });
}

}  // namespace rddlc::ir
