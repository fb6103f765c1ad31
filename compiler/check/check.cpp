#include "check/check.hpp"

#include "check/blocks.hpp"
#include "check/context.hpp"
#include "check/definitions.hpp"
#include "check/fluents.hpp"
#include "check/grounded_names.hpp"
#include "check/policy.hpp"
#include "check/types.hpp"
#include "check/values.hpp"

namespace rddlc {

std::optional<model::Model> check(const ast::Program& program, const Sources& sources,
                                  Diagnostics& diagnostics, Standard standard) {
    using namespace checking;
    Context context{sources, diagnostics, standard};
    const std::optional<Blocks> blocks = choose_blocks(program, context);
    if (!blocks) return std::nullopt;

    declare_types(*blocks, context);
    declare_fluents(*blocks, context);
    assign_values(*blocks, context);
    check_settings(*blocks, context);

    const std::vector<CpfUses> uses = check_cpfs(*blocks, context);
    order_cpfs(context.model.cpfs, uses, context);
    check_reward(*blocks, context);
    check_conditions(*blocks, context);
    check_policy(*blocks, context);
    if (diagnostics.has_errors()) return std::nullopt;
    check_grounded_names(context);
    if (diagnostics.has_errors()) return std::nullopt;

    warn_of_unused_fluents(context);
    if (diagnostics.has_errors()) return std::nullopt;
    return std::move(context.model);
}

}  // namespace rddlc
