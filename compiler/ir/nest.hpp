// Loops right inside each other, over all combinations of their variables.
#pragma once

#include "ir/analysis.hpp"
#include "ir/ir.hpp"

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

namespace rddlc::ir {

// The statement of a block that has no other; null if it has, or is of another form.
template <class Form, class SomeBlock>
auto only_statement(SomeBlock& block) {
    using Found = decltype(std::get_if<Form>(&block.front().form));
    return block.size() == 1 ? std::get_if<Form>(&block.front().form) : Found{};
}

// Calls body(loop, span of its definition) for the outermost loops of the step.
template <class Body>
void for_each_loop(Program& program, Body&& body) {
    for (Definition& definition : program.step)
        for (Statement& statement : definition.body)
            if (auto* loop = std::get_if<Loop>(&statement.form)) body(*loop, definition.span);
}

struct Nest {
    std::vector<VariableId> variables;  // outermost first
    const Block* body;                  // of the innermost loop
};
Nest nest_of(const Loop& outermost);
Loop& innermost_loop(Loop& outermost);
Block& innermost_body(Loop& outermost);
// The reverse of nest_of: loops over these variables, outermost first, around a body; without any,
// the body.
Block looped(Block body, const std::vector<VariableId>& variables);

// The values of the lets and stores of a block, without those of its loops.
std::vector<NodeId> values_of(const Block& block);
// Whether the loop takes all of its objects, one by one or several at once.
bool takes_all_objects(const Loop& loop);

// The number of combinations of the variables' values; 1 without any variable.
std::int64_t combinations(const Program& program, std::span<const VariableId> variables);

// The row-major place among all combinations.
bool is_place_in(const Program& program, const Nest& nest, NodeId id);
// The first indices are the variables of the nest.
bool begins_with(const Program& program, const std::vector<NodeId>& indices, const Nest& nest);
// The last ones are.
bool ends_with(const Program& program, const std::vector<NodeId>& indices, const Nest& nest);
// They are the variables of the nest, and no others: the element of its objects.
bool are_variables_of(const Program& program, const std::vector<NodeId>& indices, const Nest& nest);
// Equal in all iterations of the nest, and in all environments.
bool is_same_for_all(const Properties& properties, const Nest& nest);

}  // namespace rddlc::ir
