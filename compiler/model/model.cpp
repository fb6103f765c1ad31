#include "model/model.hpp"

namespace rddlc::model {

std::int64_t Model::grounding_count(const Fluent& fluent) const {
    std::int64_t count = 1;
    for (const TypeId parameter : fluent.parameters)
        count *= static_cast<std::int64_t>(types[parameter].objects.size());
    return count;
}

std::span<const Fluent> Model::domain_fluents() const {
    return std::span(fluents).first(policy ? policy->first_fluent : fluents.size());
}

std::span<const Fluent> Model::policy_fluents() const {
    return std::span(fluents).subspan(policy ? policy->first_fluent : fluents.size());
}

}  // namespace rddlc::model
