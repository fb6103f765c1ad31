#include "passes/constants/fold_constant_expressions.hpp"

#include "ir/evaluation_budget.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/constant_values.hpp"

#include <algorithm>
#include <utility>

namespace rddlc::passes {
namespace {

bool is_known(const ir::Node& node, const ir::Properties& properties) {
    return ir::EvaluationBudget::allows(properties.cost) && properties.uniform &&
           properties.free_variables.empty() && !std::holds_alternative<ir::Constant>(node.form);
}

// The values by NodeId::index. Only the outermost known expressions matter: their parts go with
// them.
std::vector<std::optional<ir::Value>> known_values(const ir::Program& program) {
    std::vector<std::optional<ir::Value>> values(program.nodes.size());
    const std::vector<ir::Properties> properties = ir::all_properties(program);
    const ir::Evaluator evaluator(program);
    std::vector<bool> wanted(program.nodes.size());
    for (ir::NodeId root : ir::roots_of(program)) wanted[root.index] = true;
    for (std::uint32_t index = static_cast<std::uint32_t>(program.nodes.size()); index-- > 0;) {
        if (!wanted[index]) continue;
        const ir::Node& node = program.nodes[index];
        if (is_known(node, properties[index])) {
            const auto value = constant_values(evaluator, program, ir::NodeId{index}, {});
            if (value) values[index] = value->front();
        }
        if (values[index]) continue;
        for (ir::NodeId operand : ir::operands_of(node)) wanted[operand.index] = true;
    }
    return values;
}

}  // namespace

// Expressions around the new constants may be known too, so it goes on until it finds none.
ir::Program fold_constant_expressions(ir::Program program, Report& report) {
    for (;;) {
        const std::vector<std::optional<ir::Value>> values = known_values(program);
        if (std::ranges::none_of(values, [](const auto& value) { return value.has_value(); }))
            return program;
        program = ir::rewrite(
            std::move(program),
            [&](ir::Builder& builder, ir::NodeId id, const ir::Node&) -> std::optional<ir::NodeId> {
                if (!values[id.index]) return std::nullopt;
                ++report["expressions evaluated"];
                return builder.constant(*values[id.index]);
            });
    }
}

}  // namespace rddlc::passes
