#include "passes/arithmetic/rule_out_ends.hpp"

#include "ir/analysis.hpp"
#include "ir/builder.hpp"
#include "ir/rewrite.hpp"

#include <map>
#include <utility>
#include <variant>
#include <vector>

namespace rddlc::passes {
namespace {

// Whether each node is part of a CPF or of the reward.
std::vector<bool> nodes_of_step(ir::Program program) {
    for (auto* const conditions :
         {&program.preconditions, &program.invariants, &program.terminations})
        conditions->clear();
    program.reset.clear();
    program.policy.reset();
    return ir::reachable_nodes(program);
}

// The conditions that a termination joins by ||. All are false where it is, also those that could
// fault: a fault also ends the episode.
std::vector<ir::NodeId> ends(const ir::Program& program) {
    std::vector<ir::NodeId> parts;
    for (const ir::Computation& termination : program.terminations)
        if (termination.body.empty())
            for (const ir::NodeId part : ir::parts_of(program, termination.value, Operator::Or))
                parts.push_back(part);
    return parts;
}

}  // namespace

ir::Program rule_out_ends(ir::Program program, Report& report) {
    if (program.terminations.empty()) return program;
    const std::vector<bool> in_step = nodes_of_step(program);
    ir::Builder builder(program);
    std::map<ir::NodeId, ir::NodeId> known;
    for (ir::NodeId end : ends(program)) {
        const auto form = program[end].form;  // the builder moves nodes
        const auto* apply = std::get_if<ir::Apply>(&form);
        const bool is_negated = apply && apply->op == Operator::Not;
        if (is_negated) end = apply->operands.front();
        const bool is_fixed = builder.properties(end).uniform || builder.properties(end).random;
        if (!is_fixed && in_step[end.index] && known.emplace(end, builder.constant(is_negated)).second)
            ++report["ends ruled out"];
    }
    ir::replace_in_step(builder, program, known);
    return ir::collect_garbage(std::move(program));
}

}  // namespace rddlc::passes
