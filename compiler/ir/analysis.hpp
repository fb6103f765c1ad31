// Small questions about expressions, answered for a whole pool in one pass over it.
#pragma once

#include "ir/ir.hpp"
#include "ir/table_properties.hpp"
#include "vocabulary/range.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace rddlc::ir {

// Properties about a node that hold wherever it is used.
struct Properties {
    bool may_fault = false;  // evaluating it may record a fault
    bool random = false;     // it draws
    // Depends on constants and loop indices only: equal in all lanes, known to the compiler. So an
    // index that is uniform may be spelled array[i]; any other needs at(array, i).
    bool uniform = true;
    // Never inf or nan: as its range shows, or as --fast-math assumes.
    bool finite = true;
    // A real that is -0.0 for no operands: adding 0.0 changes nothing. Nan is not -0.0.
    bool never_negative_zero = true;
    bool elementary = false;  // computes an elementary function: a root, exp, a power, ...
    // Roughly the number of simple operations of one evaluation, loops multiplied out.
    double cost = 0;
    std::optional<Range> range;  // within which its value certainly lies; absent: anything, or nan
    std::vector<VariableId> free_variables;  // sorted; those not bound inside the node
};

// The properties of a node whose operands' properties are already in `known`.
Properties properties_of(const Program& program, const Node& node,
                         std::span<const Properties> known, TableProperties& tables);
// The properties of all nodes of the program, by NodeId::index.
std::vector<Properties> all_properties(const Program& program);

// Evaluating the node where it is not needed does no harm: it neither faults nor draws, and costs
// no more than a handful of operations. A Select of two cheap branches needs no branch.
bool is_cheap(const Properties& properties);
// `t == 0 ? t : t * x`, which `ground` makes of products.
bool is_guarded_product(const Program& program, const Select& select);
// Should a Select evaluate only the branch it takes? Not where both are cheap; nor for a guarded
// product: the test hardly ever holds, so x is evaluated in any
// case, may be shared with others, and needs no branch.
bool is_lazy(const Program& program, const Select& select, const Properties& then_properties,
             const Properties& else_properties);
// The value may be forgotten without anybody noticing.
inline bool is_droppable(const Properties& properties) {
    return !properties.may_fault && !properties.random;
}

// The nodes that a node uses directly, place included, in evaluation order; the body of a binder
// first.
std::vector<NodeId> operands_of(const Node& node);
// Whether has(id) holds for the node or one below it.
template <class Has>
bool any_node_of(const Program& program, NodeId id, const Has& has) {
    return has(id) || std::ranges::any_of(operands_of(program[id]), [&](NodeId operand) {
               return any_node_of(program, operand, has);
           });
}
// Whether the node or one below it is of this form.
template <class Form>
bool contains(const Program& program, NodeId id) {
    return any_node_of(
        program, id, [&](NodeId each) { return std::holds_alternative<Form>(program[each].form); });
}
// Whether the node or one below it reads the buffer.
bool reads(const Program& program, NodeId id, BufferId buffer);
// The only draw of the node and those below it; nothing if there are others, or if it is no
// Bernoulli.
std::optional<NodeId> only_bernoulli(const Program& program, NodeId id);
// The bool that a node makes a number of, 0 or 1 and never -0; nothing of another node.
std::optional<NodeId> converted_bool(const Program& program, NodeId id);
// The place of a node that draws or may fault.
std::optional<Place> place_of(const Node& node);
// The buffer that a node itself reads (Load, Search, Bits, Union, Element, Interval).
std::optional<BufferId> buffer_read_by(const Node& node);
// Whether a node is the index of this variable.
bool is_index_of(const Program& program, NodeId id, VariableId variable);
// Whether a value depends on a variable; on one of these at least; on no other one.
bool depends_on(const Properties& properties, VariableId variable);
bool depends_on_any(const Properties& properties, std::span<const VariableId> variables);
bool depends_on_none_but(const Properties& properties, std::span<const VariableId> variables);
// The operands of a chain of one operator, such as the conditions that && joins. A node that is no
// such chain is its only part.
std::vector<NodeId> parts_of(const Program& program, NodeId id, Operator op);
// The variable that a node binds in its body (Reduce, DiscreteOver).
std::optional<VariableId> bound_variable(const Node& node);

// The value of a constant of this type; nothing if it is something else.
template <class T>
std::optional<T> constant(const Program& program, NodeId id) {
    const auto* form = std::get_if<Constant>(&program[id].form);
    const T* value = form ? std::get_if<T>(&form->value) : nullptr;
    return value ? std::optional(*value) : std::nullopt;
}

// The first bound, if the bounds are an element of a table and the next one, so that they are a
// row's.
const Load* row_of(const Program& program, const Bounds& bounds);

// The definitions of reset, of the step and of the policy.
std::vector<const Definition*> definitions_of(const Program& program);
std::vector<Definition*> definitions_of(Program& program);

// The reward and all conditions, each with its name in messages and in names of tables.
template <class Of>
struct Named {
    const char* name;
    Of* computation;
};
std::vector<Named<const Computation>> computations_of(const Program& program);
std::vector<Named<Computation>> computations_of(Program& program);

// The statements of every definition and computation.
std::vector<const Block*> blocks_of(const Program& program);

// Calls visit(form) for every Let, Store, Loop or Call, those of nested loops included.
template <class Form, class Visit>
void for_each_statement(const Block& block, const Visit& visit) {
    for (const Statement& statement : block) {
        if (const auto* form = std::get_if<Form>(&statement.form)) visit(*form);
        if (const auto* loop = std::get_if<Loop>(&statement.form)) {
            for_each_statement<Form>(loop->body, visit);
        }
    }
}

// Does it write to buffers?
bool fills_tables(const Block& block);
// Does it pass tables to functions of matrices, vectors or the user? That takes room in Scratch.
bool calls_functions(const Block& block);

// The operands that a call evaluates before it reads its tables.
std::vector<NodeId> operands_of(const Call& call);

// Every value and index that the statements evaluate, in order, those of nested loops included.
std::vector<NodeId> roots_of(const Statement& statement);
std::vector<NodeId> roots_of(const Block& block);
std::vector<NodeId> roots_of(const Computation& computation);
// All of the program: the step, the reward, the conditions and the policy.
std::vector<NodeId> roots_of(const Program& program);

// The buffers that these nodes and those below them read.
std::set<BufferId> buffers_read_by(const Program& program, const std::vector<NodeId>& roots);
// The buffers that statements fill, beside those that calls work in.
std::set<BufferId> buffers_filled_by(const Block& block);

// Whether each node, by NodeId::index, is part of something that the program evaluates.
std::vector<bool> reachable_nodes(const Program& program);

// The buffers of the state and the action whose reals have a range, so that a step relies on it.
// Some are not read any more: what is left out for them is right for finite values only.
std::vector<BufferId> reals_taken_for_moderate(const Program& program);

// Does reset, the step, the reward or a condition draw at random? And does the policy?
bool is_stochastic(const Program& program);
bool is_policy_stochastic(const Program& program);

}  // namespace rddlc::ir
