#include "passes/analyses/few_true.hpp"

#include <algorithm>
#include <vector>

namespace rddlc::passes {

bool begins_with_few_true(const ir::Buffer& buffer, std::int64_t least_per_true) {
    if (buffer.storage != ir::Storage::State || buffer.scalar != ir::Scalar::Bool) return false;
    const std::vector<ir::Value> values = buffer.values.dense();
    const std::int64_t count = std::ranges::count(values, ir::Value(true));
    return count > 0 && count * least_per_true <= std::ssize(values);
}

}  // namespace rddlc::passes
