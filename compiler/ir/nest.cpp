#include "ir/nest.hpp"

#include "ir/analysis.hpp"

#include <algorithm>
#include <span>

namespace rddlc::ir {
namespace {

bool are_indices_of(const Program& program, const Nest& nest, std::span<const NodeId> ids) {
    return std::ranges::equal(nest.variables, ids, [&](VariableId variable, NodeId id) {
        return is_index_of(program, id, variable);
    });
}

const Apply* applied(const Program& program, Operator op, NodeId id) {
    const auto* apply = std::get_if<Apply>(&program[id].form);
    return apply && apply->op == op ? apply : nullptr;
}

// (x * size of y) + y
bool is_place(const Program& program, std::span<const VariableId> variables, NodeId id) {
    if (variables.size() == 1) return is_index_of(program, id, variables.front());
    const auto* sum = applied(program, Operator::Add, id);
    if (!sum || !is_index_of(program, sum->operands[1], variables.back())) return false;
    const auto* rows = applied(program, Operator::Multiply, sum->operands[0]);
    if (!rows) return false;
    const auto* size = std::get_if<Constant>(&program[rows->operands[1]].form);
    return size && size->value == Value(program[variables.back()].size) &&
           is_place(program, variables.first(variables.size() - 1), rows->operands[0]);
}

}  // namespace

Nest nest_of(const Loop& outermost) {
    Nest nest{{outermost.variable}, &outermost.body};
    while (const auto* inner = only_statement<Loop>(*nest.body)) {
        nest.variables.push_back(inner->variable);
        nest.body = &inner->body;
    }
    return nest;
}

Loop& innermost_loop(Loop& outermost) {
    auto* const inner = only_statement<Loop>(outermost.body);
    return inner ? innermost_loop(*inner) : outermost;
}
Block& innermost_body(Loop& outermost) {
    return innermost_loop(outermost).body;
}

Block looped(Block body, const std::vector<VariableId>& variables) {
    for (auto variable = variables.rbegin(); variable != variables.rend(); ++variable) {
        Block outer;
        outer.push_back({Loop{.variable = *variable, .body = std::move(body)}});
        body = std::move(outer);
    }
    return body;
}

std::vector<NodeId> values_of(const Block& block) {
    std::vector<NodeId> values;
    for (const Statement& statement : block) {
        if (const auto* let = std::get_if<Let>(&statement.form)) values.push_back(let->value);
        if (const auto* store = std::get_if<Store>(&statement.form)) values.push_back(store->value);
    }
    return values;
}

bool takes_all_objects(const Loop& loop) {
    return !loop.as_words && !loop.affected && !loop.chosen && !loop.clearances && !loop.shifts;
}

std::int64_t combinations(const Program& program, std::span<const VariableId> variables) {
    std::int64_t count = 1;
    for (const VariableId variable : variables) count *= program[variable].size;
    return count;
}

bool is_place_in(const Program& program, const Nest& nest, NodeId id) {
    return is_place(program, nest.variables, id);
}

bool begins_with(const Program& program, const std::vector<NodeId>& indices, const Nest& nest) {
    return indices.size() >= nest.variables.size() &&
           are_indices_of(program, nest, std::span(indices).first(nest.variables.size()));
}

bool ends_with(const Program& program, const std::vector<NodeId>& indices, const Nest& nest) {
    return indices.size() >= nest.variables.size() &&
           are_indices_of(program, nest, std::span(indices).last(nest.variables.size()));
}

bool are_variables_of(const Program& program, const std::vector<NodeId>& indices,
                      const Nest& nest) {
    return indices.size() == nest.variables.size() && begins_with(program, indices, nest);
}

bool is_same_for_all(const Properties& properties, const Nest& nest) {
    return properties.uniform && !depends_on_any(properties, nest.variables);
}

}  // namespace rddlc::ir
