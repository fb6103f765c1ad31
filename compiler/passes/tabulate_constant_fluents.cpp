#include "passes/tabulate_constant_fluents.hpp"

#include "ir/rewrite.hpp"
#include "passes/constant_values.hpp"
#include "passes/plain_definition.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace rddlc::passes {
namespace {

// Larger tables are left to the simulator: they make the emitted text long.
constexpr std::int64_t most_entries = 100'000;
// In operations (Facts::cost).
constexpr double affordable_cost = 1e7;

// The values of a definition that fills an interm-fluent with what the instance fixes.
std::optional<std::vector<ir::Value>> known_values(const ir::Program& program,
                                                   const ir::Definition& definition) {
    const ir::Buffer& buffer = program[definition.target];
    if (buffer.storage != ir::Storage::Scratch || buffer.count() > most_entries)
        return std::nullopt;
    const auto plain = plain_definition(program, definition);
    if (!plain) return std::nullopt;
    const ir::Facts facts = ir::all_facts(program)[plain->value.index];
    const double cost = facts.cost * static_cast<double>(buffer.count());
    if (!facts.uniform || cost > affordable_cost) return std::nullopt;

    std::vector<ir::VariableId> variables;
    for (const auto& variable : plain->variables) {
        if (variable) variables.push_back(*variable);
    }
    return constant_values(ir::Evaluator(program), program, plain->value, variables);
}

}  // namespace

ir::Program tabulate_constant_fluents(ir::Program program, Report& report) {
    // One after the other: what reads a constant fluent may be constant, too.
    for (std::size_t k = 0; k < program.step.size(); ++k) {
        auto values = known_values(program, program.step[k]);
        if (!values) continue;
        const ir::BufferId old = program.step[k].target;
        const ir::BufferId table{static_cast<std::uint32_t>(program.buffers.size())};
        ir::Buffer buffer = program[old];
        buffer.storage = ir::Storage::Constant;
        buffer.values = *std::move(values);
        program.buffers.push_back(std::move(buffer));
        ++report["interm-fluents made constant"];

        program = ir::rewrite(std::move(program),
                              [&](ir::Builder& builder, ir::NodeId,
                                  const ir::Node& node) -> std::optional<ir::NodeId> {
                                  const auto* load = std::get_if<ir::Load>(&node.form);
                                  if (!load || load->buffer != old) return std::nullopt;
                                  return builder.load(table, load->indices);
                              });
    }
    return program;
}

}  // namespace rddlc::passes
