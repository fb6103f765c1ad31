#include "passes/analyses/few_true.hpp"

#include <algorithm>
#include <vector>

namespace rddlc::passes {

bool begins_with_few_true(const ir::Buffer& buffer, std::int64_t least_places) {
    if (buffer.storage != ir::Storage::State || buffer.scalar != ir::Scalar::Bool) return false;
    const std::vector<ir::Value> values = buffer.values.dense();
    const std::int64_t count = std::ranges::count(values, ir::Value(true));
    return count > 0 && count * least_places <= std::ssize(values);
}

bool acts_with_few_true(const ir::Buffer& buffer, std::int64_t least_places) {
    const auto is_false = [](const ir::Value& value) {
        return value == ir::Value(false);
    };
    return buffer.most_true && *buffer.most_true <= buffer.count() / least_places &&
           buffer.values.all_of(is_false);
}

}  // namespace rddlc::passes
