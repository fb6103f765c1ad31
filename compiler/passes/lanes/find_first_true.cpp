#include "passes/lanes/find_first_true.hpp"

#include "ir/analysis.hpp"
#include "ir/nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/plain_definition.hpp"
#include "passes/analyses/readers.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// The lowest bit of an int has a place below its sign.
constexpr std::int64_t most_bits = 62;

// The row of a table by the variable of an argmax, which has all elements of the row in their
// order.
const ir::Load* row_of(const ir::Program& program, const ir::Reduce& reduce, ir::NodeId body) {
    const auto* load = std::get_if<ir::Load>(&program[body].form);
    if (reduce.op != Reduction::ArgMax || reduce.bounds || !load || load->indices.empty() ||
        program[load->buffer].storage == ir::Storage::Constant ||
        program[reduce.variable].size > most_bits)
        return nullptr;
    const std::size_t leading = load->indices.size() - 1;
    const bool is_row = ir::is_index_of(program, load->indices.back(), reduce.variable) &&
                        program[load->buffer].row_size(leading) == program[reduce.variable].size;
    return is_row ? load : nullptr;
}

// Scratch tables of bools as numbers that only such rows are read of.
std::set<ir::BufferId> tables_of_bools(const ir::Program& program) {
    std::set<ir::NodeId> rows;
    for (const ir::Node& node : program.nodes)
        if (const auto* reduce = std::get_if<ir::Reduce>(&node.form))
            if (row_of(program, *reduce, reduce->body)) rows.insert(reduce->body);
    std::set<ir::NodeId> others;
    const std::vector<bool> reachable = ir::reachable_nodes(program);
    for (std::size_t i = 0; i < program.nodes.size(); ++i) {
        const ir::Node& node = program.nodes[i];
        const auto* reduce = std::get_if<ir::Reduce>(&node.form);
        if (!reachable[i] || (reduce && row_of(program, *reduce, reduce->body))) continue;
        for (const ir::NodeId operand : ir::operands_of(node)) others.insert(operand);
    }
    for (const ir::Definition* definition : ir::definitions_of(program))
        for (const ir::NodeId root : ir::roots_of(definition->body)) others.insert(root);
    for (const ir::NodeId root : ir::roots_of(program.reward)) others.insert(root);
    std::set<ir::BufferId> tables;
    const std::vector<Readers> readers = readers_of_step(program);
    for (const ir::Definition& definition : program.step) {
        const ir::Buffer& buffer = program[definition.target];
        const Readers& of_buffer = readers[definition.target.index];
        const auto plain = plain_definition(program, definition);
        const bool is_only_row = std::ranges::all_of(of_buffer.loads, [&](ir::NodeId load) {
            return rows.contains(load) && !others.contains(load);
        });
        if (buffer.storage == ir::Storage::Scratch && buffer.scalar != ir::Scalar::Bool && plain &&
            ir::converted_bool(program, plain->value) && !of_buffer.loads.empty() &&
            !of_buffer.functions && is_only_row && !program.policy)
            tables.insert(definition.target);
    }
    return tables;
}

// Stores the bools themselves.
void store_bools(ir::Program& program, ir::Block& block, const std::set<ir::BufferId>& tables) {
    for (ir::Statement& statement : block) {
        if (auto* loop = std::get_if<ir::Loop>(&statement.form)) {
            store_bools(program, loop->body, tables);
            const auto* store = ir::only_statement<ir::Store>(loop->body);
            const bool are_drawn = store && tables.contains(store->target) &&
                                   std::holds_alternative<ir::Sample>(program[store->value].form);
            loop->several_at_once = loop->several_at_once || are_drawn;
        }
        auto* const store = std::get_if<ir::Store>(&statement.form);
        if (store && tables.contains(store->target))
            store->value = *ir::converted_bool(program, store->value);
    }
}

// The number of bits below the lowest one that is 1, of so many; 0 if all bits are 0. The last mask
// shows how many these may be.
ir::NodeId place_of_lowest(ir::Builder& builder, ir::NodeId bits, std::int64_t count) {
    const auto constant = [&](std::int64_t value) {
        return builder.constant(value);
    };
    const ir::NodeId is_none = builder.apply(Operator::Equal, {bits, constant(0)});
    const ir::NodeId lowest = builder.convert(is_none, ir::Scalar::Int);
    const ir::NodeId some = builder.apply(Operator::BitOr, {bits, lowest});
    const ir::NodeId less = builder.apply(Operator::Subtract, {some, constant(1)});
    const ir::NodeId differing = builder.apply(Operator::BitXor, {some, less});
    const ir::NodeId below = builder.apply(Operator::BitAnd, {differing, less});
    const std::int64_t others = (std::int64_t{1} << (count - 1)) - 1;
    return builder.apply(Operator::CountOnes,
                         {builder.apply(Operator::BitAnd, {below, constant(others)})});
}

std::optional<ir::NodeId> first_true(ir::Builder& builder, const ir::Reduce& reduce,
                                     const std::set<ir::BufferId>& tables) {
    const auto bools = ir::converted_bool(builder.program(), reduce.body);
    const ir::Load* const found = row_of(builder.program(), reduce, bools ? *bools : reduce.body);
    if (!found || !(bools || tables.contains(found->buffer))) return std::nullopt;
    const std::int64_t count = builder.program()[reduce.variable].size;
    ir::Load load = *found;  // new nodes move the others
    load.indices.pop_back();
    const bool is_same_row = std::ranges::all_of(load.indices, [&](ir::NodeId index) {
        const ir::Properties& properties = builder.properties(index);
        return properties.uniform && !ir::depends_on(properties, reduce.variable);
    });
    if (!is_same_row) return std::nullopt;
    return place_of_lowest(builder, builder.bits(load.buffer, 0, std::move(load.indices)), count);
}

}  // namespace

ir::Program find_first_true(ir::Program program, Report& report) {
    const std::set<ir::BufferId> tables = tables_of_bools(program);
    for (ir::Definition& definition : program.step) store_bools(program, definition.body, tables);
    for (const ir::BufferId table : tables) {
        program.buffers[table.index].scalar = ir::Scalar::Bool;
        program.buffers[table.index].range = std::nullopt;
    }
    return ir::rewrite(
        std::move(program),
        [&](ir::Builder& builder, ir::NodeId, const ir::Node& node) -> std::optional<ir::NodeId> {
            const auto* reduce = std::get_if<ir::Reduce>(&node.form);
            const auto result = reduce ? first_true(builder, *reduce, tables) : std::nullopt;
            if (result) ++report["greatest of bools"];
            return result;
        });
}

}  // namespace rddlc::passes
