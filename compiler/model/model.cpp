#include "model/model.hpp"

namespace rddlc::model {

std::int64_t Model::grounding_count(const Fluent& fluent) const {
    std::int64_t count = 1;
    for (const TypeId parameter : fluent.parameters)
        count *= static_cast<std::int64_t>(types[parameter].objects.size());
    return count;
}

}  // namespace rddlc::model
