#include "check/check.hpp"

#include "check/blocks.hpp"
#include "check/context.hpp"
#include "check/definitions.hpp"
#include "check/fluents.hpp"
#include "check/grounded_names.hpp"
#include "check/policy.hpp"
#include "check/types.hpp"
#include "check/values.hpp"

#include <algorithm>
#include <type_traits>
#include <variant>

namespace rddlc {

namespace checking {
namespace {

// Fills the model of the context; complete if there are no errors and there is an instance.
void check_blocks(const ast::Program& program, Context& context) {
    const std::optional<Blocks> blocks = choose_blocks(program, context);
    if (!blocks) return;

    declare_types(*blocks, context);
    declare_fluents(*blocks, context);
    assign_values(*blocks, context);
    check_settings(*blocks, context);

    const std::vector<CpfUses> uses = check_cpfs(*blocks, context);
    order_cpfs(context.model.cpfs, uses, context);
    check_reward(*blocks, context);
    check_conditions(*blocks, context);
    check_policy(*blocks, context);
    if (context.diagnostics.has_errors()) return;
    check_grounded_names(context);
    if (context.diagnostics.has_errors()) return;

    warn_of_unused_fluents(context);
}

}  // namespace
}  // namespace checking

std::optional<model::Model> check(const ast::Program& program, const Sources& sources,
                                  Diagnostics& diagnostics, Standard standard) {
    checking::Context context{sources, diagnostics, standard};
    checking::check_blocks(program, context);
    if (diagnostics.has_errors()) return std::nullopt;
    return std::move(context.model);
}

bool is_domain_alone(const ast::Program& program) {
    const auto has = [&]<class Block>(std::type_identity<Block>) {
        return std::ranges::any_of(program.blocks, [](const ast::Block& block) {
            return std::holds_alternative<Block>(block);
        });
    };
    return has(std::type_identity<ast::Domain>{}) && !has(std::type_identity<ast::Instance>{});
}

std::optional<model::Model> check_domain(const ast::Program& program, const Sources& sources,
                                         Diagnostics& diagnostics, Standard standard) {
    checking::Context context{sources, diagnostics, standard};
    context.needs_instance = false;
    checking::check_blocks(program, context);
    if (diagnostics.has_errors()) return std::nullopt;
    return std::move(context.model);
}

const ast::Name* named_non_fluents(const ast::Instance& instance) {
    const ast::Name* name = nullptr;
    for (const ast::InstanceSection& section : instance.sections)
        if (const auto* named = std::get_if<ast::NonFluentsName>(&section.node))
            name = &named->name;
    return name;
}

}  // namespace rddlc
