#include "check/policy.hpp"

#include "check/definitions.hpp"
#include "check/fluents.hpp"

#include <utility>

namespace rddlc::checking {

void check_policy(const Blocks& blocks, Context& context) {
    if (!blocks.policy) return;
    const auto first_fluent = static_cast<model::FluentId>(context.model.fluents.size());
    const ast::Name& name = blocks.policy->name;
    context.model.policy = model::Policy{name.text, first_fluent, {}, name.span};
    declare_policy_fluents(blocks, context);
    const std::vector<CpfUses> uses = check_policy_cpfs(blocks, context);
    order_cpfs(context.model.policy->cpfs, uses, context);
}

}  // namespace rddlc::checking
