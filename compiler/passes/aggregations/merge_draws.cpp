#include "passes/aggregations/merge_draws.hpp"

#include "ir/rewrite.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

const ir::Sample* draw(const ir::Program& program, ir::NodeId id) {
    return std::get_if<ir::Sample>(&program[id].form);
}

bool have_same_numbers(const ir::Program& program, const ir::Sample& a, const ir::Sample& b) {
    return program.series_of(a.place.site) == program.series_of(b.place.site) &&
           a.place.index == b.place.index;
}

bool may_be_wrong(const ir::Builder& builder, const ir::Sample& sample) {
    std::vector<std::optional<Range>> ranges;
    for (ir::NodeId parameter : sample.parameters)
        ranges.push_back(builder.properties(parameter).range);
    return !always_in_domain(sample.distribution, ranges);
}

// The probability with which a bool is true.
std::optional<double> certainty(const ir::Program& program, ir::NodeId id) {
    const auto value = ir::constant<bool>(program, id);
    if (!value) return std::nullopt;
    return *value ? 1.0 : 0.0;
}

void collect(const ir::Program& program, ir::NodeId id, std::set<ir::NodeId>& below) {
    if (!below.insert(id).second) return;
    for (ir::NodeId operand : ir::operands_of(program[id])) collect(program, operand, below);
}

bool share_an_aggregation(const ir::Program& program, ir::NodeId a, ir::NodeId b) {
    std::set<ir::NodeId> below_a, below_b;
    collect(program, a, below_a);
    collect(program, b, below_b);
    return std::ranges::any_of(below_a, [&](ir::NodeId id) {
        return std::holds_alternative<ir::Reduce>(program[id].form) && below_b.contains(id);
    });
}

// A draw in one branch, a constant in the other one.
std::optional<ir::NodeId> merged_with_constant(ir::Builder& builder, const ir::Select& select) {
    const ir::Program& program = builder.program();
    const ir::NodeId condition = select.condition;
    const bool is_else = draw(program, select.else_value) != nullptr;
    const ir::Sample* sample = draw(program, is_else ? select.else_value : select.then_value);
    const auto other = certainty(program, is_else ? select.then_value : select.else_value);
    if (!sample || !other || sample->distribution != Distribution::Bernoulli) return std::nullopt;
    const ir::NodeId chance = sample->parameters.front();
    if (!share_an_aggregation(program, condition, chance)) return std::nullopt;

    const ir::Place place = sample->place;
    const ir::NodeId constant = builder.constant(*other);
    const ir::NodeId chosen = is_else ? builder.select(condition, constant, chance)
                                      : builder.select(condition, chance, constant);
    return builder.sample(ir::Scalar::Bool, Distribution::Bernoulli, place, {chosen});
}

// How often the program names each node, by NodeId::index.
std::vector<int> count_uses(const ir::Program& program) {
    std::vector<int> uses(program.nodes.size());
    const std::vector<bool> reachable = ir::reachable_nodes(program);
    for (const ir::NodeId root : ir::roots_of(program)) ++uses[root.index];
    for (std::size_t index = 0; index < uses.size(); ++index) {
        if (!reachable[index]) continue;
        for (const ir::NodeId operand : ir::operands_of(program.nodes[index]))
            ++uses[operand.index];
    }
    return uses;
}

// Only this Select uses both branches, or the branch that is not constant. A draw that is used
// elsewhere stays a draw of its own, and then the merged one would draw from its site once more.
bool are_only_here(const ir::Program& program, const ir::Select& select,
                   const std::vector<int>& uses) {
    const auto is_only_here = [&](ir::NodeId branch) {
        return std::holds_alternative<ir::Constant>(program[branch].form) ||
               uses[branch.index] == 1;
    };
    return is_only_here(select.then_value) && is_only_here(select.else_value);
}

// Selects whose branches may become one, by NodeId::index.
std::vector<bool> candidates(const ir::Program& program) {
    const std::vector<int> uses = count_uses(program);
    std::vector<bool> found;
    for (const ir::Node& node : program.nodes) {
        const auto* select = std::get_if<ir::Select>(&node.form);
        found.push_back(select && are_only_here(program, *select, uses));
    }
    return found;
}

std::optional<ir::NodeId> merged(ir::Builder& builder, const ir::Select& select) {
    const ir::Program& program = builder.program();
    const ir::Sample* then_draw = draw(program, select.then_value);
    const ir::Sample* else_draw = draw(program, select.else_value);
    if (!then_draw || !else_draw || then_draw->distribution != else_draw->distribution ||
        !have_same_numbers(program, *then_draw, *else_draw)) {
        return std::nullopt;
    }
    const bool then_faults = may_be_wrong(builder, *then_draw);
    const bool else_faults = may_be_wrong(builder, *else_draw);
    if (then_faults && else_faults) return std::nullopt;

    const ir::Sample a = *then_draw, b = *else_draw;  // building nodes moves the pool
    std::vector<ir::NodeId> parameters;
    for (std::size_t k = 0; k < a.parameters.size(); ++k)
        parameters.push_back(builder.select(select.condition, a.parameters[k], b.parameters[k]));
    return builder.sample(program[select.then_value].type, a.distribution,
                          else_faults ? b.place : a.place, std::move(parameters));
}

}  // namespace

ir::Program merge_draws(ir::Program program, Report& report) {
    const std::vector<bool> is_candidate = candidates(program);
    return ir::rewrite(std::move(program),
                       [&](ir::Builder& builder, ir::NodeId id,
                           const ir::Node& node) -> std::optional<ir::NodeId> {
                           if (!is_candidate[id.index]) return std::nullopt;
                           const auto* select = std::get_if<ir::Select>(&node.form);
                           if (const auto draw = merged(builder, *select)) {
                               ++report["pairs of draws made one"];
                               return draw;
                           }
                           const auto draw = merged_with_constant(builder, *select);
                           if (draw) ++report["draws made to include constants"];
                           return draw;
                       });
}

}  // namespace rddlc::passes
