#include "passes/find_finite_fluents.hpp"

#include "ir/analysis.hpp"
#include "passes/constant_values.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace rddlc::passes {
namespace {

using Buffers = std::set<ir::BufferId>;

// In operations (Facts::cost), for all values of a divisor.
constexpr double affordable_cost = 4e6;

bool is_finite(const ir::Value& value) {
    const auto* real = std::get_if<double>(&value);
    return !real || std::isfinite(*real);
}

Buffers filled_by_calls(const ir::Program& program) {
    Buffers filled;
    for (const ir::Block* block : ir::blocks_of(program)) {
        ir::for_each_statement<ir::Call>(
            *block, [&](const ir::Call& call) { filled.insert(call.output.buffer); });
    }
    return filled;
}

// Not known to be finite yet, and computed by expressions alone.
Buffers candidates_in(const ir::Program& program) {
    const Buffers filled = filled_by_calls(program);
    Buffers candidates;
    for (std::uint32_t index = 0; index < program.buffers.size(); ++index) {
        const ir::Buffer& buffer = program.buffers[index];
        const bool is_computed =
            buffer.storage != ir::Storage::Constant && buffer.storage != ir::Storage::Action;
        if (is_computed && !buffer.finite && !filled.contains({index}) &&
            buffer.values.all_of(is_finite))
            candidates.insert({index});
    }
    return candidates;
}

double evaluations(const ir::Program& program, const ir::Facts& facts) {
    double count = 1;
    for (const ir::VariableId variable : facts.free_variables)
        count *= static_cast<double>(program[variable].size);
    return count;
}

// Has it only values that the instance fixes, and none of them is 0?
bool is_never_zero(const ir::Program& program, ir::NodeId id, const ir::Facts& facts) {
    if (!facts.uniform || facts.cost * evaluations(program, facts) > affordable_cost) return false;
    const auto values = constant_values(ir::Evaluator(program), program, id, facts.free_variables);
    return values && std::ranges::find(*values, ir::Value(0.0)) == values->end() &&
           std::ranges::all_of(*values, is_finite);
}

// The quotients that are finite since their divisors are never zero.
std::set<ir::NodeId> safe_quotients(const ir::Program& program) {
    const std::vector<ir::Facts> facts = ir::all_facts(program);
    std::set<ir::NodeId> safe;
    for (std::uint32_t index = 0; index < program.nodes.size(); ++index) {
        const auto* apply = std::get_if<ir::Apply>(&program.nodes[index].form);
        if (!apply || apply->op != Operator::Divide) continue;
        const ir::NodeId divisor = apply->operands.back();
        if (is_never_zero(program, divisor, facts[divisor.index])) safe.insert({index});
    }
    return safe;
}

std::vector<ir::Facts> facts_with(const ir::Program& program, const std::set<ir::NodeId>& safe) {
    std::vector<ir::Facts> facts;
    for (std::uint32_t index = 0; index < program.nodes.size(); ++index) {
        const ir::Node& node = program.nodes[index];
        facts.push_back(ir::facts_of(program, node, facts));
        if (safe.contains({index}))
            facts.back().finite =
                facts[std::get<ir::Apply>(node.form).operands.front().index].finite;
    }
    return facts;
}

// One in which something is stored that may be inf or nan.
std::optional<ir::BufferId> refuted(const ir::Program& program, const Buffers& candidates,
                                    const std::vector<ir::Facts>& facts) {
    std::optional<ir::BufferId> found;
    for (const ir::Block* block : ir::blocks_of(program)) {
        ir::for_each_statement<ir::Store>(*block, [&](const ir::Store& store) {
            if (candidates.contains(store.target) && !facts[store.value.index].finite)
                found = store.target;
        });
    }
    return found;
}

// One is the other in the next step, or both are the same.
bool are_one_fluent(const ir::Buffer& a, const ir::Buffer& b) {
    const auto without_next = [](ir::Storage storage) {
        if (storage == ir::Storage::Next) return ir::Storage::State;
        return storage == ir::Storage::NextMemory ? ir::Storage::Memory : storage;
    };
    return a.name == b.name && without_next(a.storage) == without_next(b.storage);
}

}  // namespace

ir::Program find_finite_fluents(ir::Program program, Report& report) {
    Buffers candidates = candidates_in(program);
    const std::set<ir::NodeId> safe =
        candidates.empty() ? std::set<ir::NodeId>() : safe_quotients(program);
    for (const ir::BufferId id : candidates) program.buffers[id.index].finite = true;
    while (const auto wrong = refuted(program, candidates, facts_with(program, safe))) {
        std::erase_if(candidates, [&](ir::BufferId id) {
            const bool is_wrong = are_one_fluent(program[id], program[*wrong]);
            if (is_wrong) program.buffers[id.index].finite = false;
            return is_wrong;
        });
    }
    report["tables found finite"] += static_cast<std::int64_t>(candidates.size());
    return program;
}

}  // namespace rddlc::passes
