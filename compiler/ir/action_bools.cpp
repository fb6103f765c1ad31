#include "ir/action_bools.hpp"

#include "support/match.hpp"

#include <algorithm>
#include <cstdint>

namespace rddlc::ir {
namespace {

// Bools of one table: below that, a test of all takes an instruction or two.
constexpr std::int64_t many_bools = 128;

bool is_action_bool(const Program& program, BufferId id) {
    const Buffer& buffer = program[id];
    return buffer.storage == Storage::Action && buffer.scalar == Scalar::Bool;
}

// Then the element stands in brackets in the text, not behind a function that copies it.
bool is_of_objects(const Program& program, NodeId index) {
    const auto are_of_objects = [&](const std::vector<NodeId>& parts) {
        return std::ranges::all_of(parts,
                                   [&](NodeId part) { return is_of_objects(program, part); });
    };
    return match(
        program[index].form, [](const Index&) { return true; },
        [](const Constant&) { return true; },
        [&](const Load& load) {
            return program[load.buffer].storage == Storage::Constant &&
                   are_of_objects(load.indices);
        },
        [&](const Apply& apply) { return !apply.place && are_of_objects(apply.operands); },
        [](const auto&) { return false; });
}

bool is_read_by_bytes(const Program& program, const Load& load) {
    if (!is_action_bool(program, load.buffer)) return true;
    const auto is_object = [&](NodeId index) {
        return is_of_objects(program, index);
    };
    if (!std::ranges::all_of(load.indices, is_object)) return false;
    return load.gather == Gather::None || load.gather == Gather::InRow ||
           (load.gather == Gather::Adjacent && load.indices.size() == 1);
}

bool is_passed_whole(const Program& program, const Block& block) {
    return std::ranges::any_of(block, [&](const Statement& statement) {
        if (const auto* loop = std::get_if<Loop>(&statement.form))
            return is_passed_whole(program, loop->body);
        const auto* call = std::get_if<Call>(&statement.form);
        return call && std::ranges::any_of(call->inputs, [&](const TableView& input) {
                   return is_action_bool(program, input.buffer);
               });
    });
}

bool reads_by_bytes(const Program& program) {
    const auto reads = [&](const Node& node) {
        const auto* load = std::get_if<Load>(&node.form);
        return !load || is_read_by_bytes(program, *load);
    };
    const auto passes = [&](const auto& part) {
        return is_passed_whole(program, part.body);
    };
    return std::ranges::all_of(program.nodes, reads) &&
           std::ranges::none_of(program.step, passes) &&
           std::ranges::none_of(program.preconditions, passes) && !passes(program.reward);
}

}  // namespace

bool tests_action_bools(const Program& program) {
    const bool has_many = std::ranges::any_of(program.buffers, [&](const Buffer& buffer) {
        return buffer.storage == Storage::Action && buffer.scalar == Scalar::Bool &&
               buffer.count() >= many_bools;
    });
    return has_many && !program.policy && reads_by_bytes(program) &&
           (!program.moderate || reads_by_bytes(**program.moderate));
}

}  // namespace rddlc::ir
