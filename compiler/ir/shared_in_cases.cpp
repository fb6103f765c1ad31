#include "ir/shared_in_cases.hpp"

#include <map>
#include <variant>

namespace rddlc::ir {
namespace {

// Different expressions that use an aggregation, and the operations (Properties::cost) of one.
constexpr int fewest_uses = 3;
constexpr double greatest_cost = 40;

// How many expressions use each node below this one.
void count_uses(const Program& program, NodeId id, std::map<NodeId, int>& uses) {
    if (++uses[id] > 1) return;
    for (const NodeId operand : operands_of(program[id])) count_uses(program, operand, uses);
}

bool can_be_shared(const Program& program, NodeId id, const Properties& properties) {
    return std::holds_alternative<Reduce>(program[id].form) && properties.free_variables.empty() &&
           is_droppable(properties) && !properties.elementary && properties.cost <= greatest_cost;
}

}  // namespace

std::vector<NodeId> shared_in_cases(const Program& program, std::span<const Properties> properties,
                                    const Select& select) {
    if (select.evaluated != Evaluated::Jump) return {};
    std::map<NodeId, int> uses;
    count_uses(program, select.then_value, uses);
    std::vector<NodeId> shared;
    for (const auto& [id, count] : uses)
        if (count >= fewest_uses && can_be_shared(program, id, properties[id.index]))
            shared.push_back(id);
    return shared;
}

}  // namespace rddlc::ir
