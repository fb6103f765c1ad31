#include "ir/action_bools.hpp"

#include "ir/analysis.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <cstdint>

namespace rddlc::ir {
namespace {

// Bools of one table: below that, a test of all takes an instruction or two.
constexpr std::int64_t many_bools = 128;

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
    if (!is_action_bools(program[load.buffer])) return true;
    const auto is_object = [&](NodeId index) {
        return is_of_objects(program, index);
    };
    if (!std::ranges::all_of(load.indices, is_object)) return false;
    return load.gather == Gather::None || load.gather == Gather::InRow ||
           (load.gather == Gather::Adjacent && load.indices.size() == 1);
}

bool passes_whole_tables(const Program& program) {
    bool passes = false;
    for (const Block* block : blocks_of(program))
        for_each_statement<Call>(*block, [&](const Call& call) {
            for (const TableView& input : call.inputs)
                passes = passes || is_action_bools(program[input.buffer]);
        });
    return passes;
}

bool reads_by_bytes(const Program& program) {
    const auto reads = [&](const Node& node) {
        const auto* load = std::get_if<Load>(&node.form);
        return !load || is_read_by_bytes(program, *load);
    };
    return std::ranges::all_of(program.nodes, reads) && !passes_whole_tables(program);
}

}  // namespace

bool is_action_bools(const Buffer& buffer) {
    return buffer.storage == Storage::Action && buffer.scalar == Scalar::Bool;
}

bool tests_action_bools(const Program& program) {
    const bool has_many = std::ranges::any_of(program.buffers, [](const Buffer& buffer) {
        return is_action_bools(buffer) && buffer.count() >= many_bools;
    });
    return has_many && !program.policy && reads_by_bytes(program) &&
           (!program.moderate || reads_by_bytes(**program.moderate));
}

}  // namespace rddlc::ir
