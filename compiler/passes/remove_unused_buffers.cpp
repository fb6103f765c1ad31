#include "passes/remove_unused_buffers.hpp"

#include "ir/analysis.hpp"
#include "ir/call.hpp"
#include "ir/rewrite.hpp"

#include <algorithm>
#include <utility>

namespace rddlc::passes {
namespace {

bool may_fault(const ir::Definition& definition, const std::vector<ir::Facts>& facts) {
    bool may_fault = std::ranges::any_of(ir::roots_of(definition.body), [&](ir::NodeId root) {
        return facts[root.index].may_fault;
    });
    ir::for_each_statement<ir::Call>(
        definition.body, [&](const ir::Call& call) { may_fault |= ir::is_draw(call.callee); });
    return may_fault;
}

// Read by something that the program evaluates, or part of a record that others see.
std::vector<bool> used_buffers(const ir::Program& program) {
    std::vector<bool> used(program.buffers.size());
    for (std::size_t index = 0; index < used.size(); ++index) {
        const ir::Storage storage = program.buffers[index].storage;
        used[index] = storage != ir::Storage::Constant && storage != ir::Storage::Scratch;
    }
    const std::vector<bool> reachable = ir::reachable_nodes(program);
    for (std::size_t index = 0; index < program.nodes.size(); ++index) {
        const auto buffer = ir::buffer_read_by(program.nodes[index]);
        if (buffer && reachable[index]) used[buffer->index] = true;
    }
    for (const ir::Block* block : ir::blocks_of(program)) {
        ir::for_each_statement<ir::Call>(*block, [&](const ir::Call& call) {
            for (const ir::TableView& input : call.inputs) used[input.buffer.index] = true;
        });
    }
    return used;
}

// Drops the last definition that nobody needs; false if there is none. Backwards, because what
// only it read is not needed then either.
bool drop_a_definition(ir::Program& program, const std::vector<ir::Facts>& facts) {
    const std::vector<bool> used = used_buffers(program);
    const auto is_needed = [&](const ir::Definition& definition) {
        return used[definition.target.index] || may_fault(definition, facts);
    };
    const auto drop_from = [&](std::vector<ir::Definition>& definitions) {
        const auto last = std::find_if_not(definitions.rbegin(), definitions.rend(), is_needed);
        if (last == definitions.rend()) return false;
        definitions.erase(std::prev(last.base()));
        return true;
    };
    return drop_from(program.step) || (program.policy && drop_from(program.policy->act));
}

// Removes buffers that are neither read nor written and renumbers the others.
void drop_buffers(ir::Program& program, Report& report) {
    std::vector<bool> used = used_buffers(program);
    for (const ir::Block* block : ir::blocks_of(program)) {
        for (ir::BufferId written : ir::written_buffers(*block)) used[written.index] = true;
    }
    std::vector<ir::BufferId> renumbered(used.size());
    std::vector<ir::Buffer> kept;
    for (std::size_t index = 0; index < used.size(); ++index) {
        renumbered[index] = {static_cast<std::uint32_t>(kept.size())};
        ir::Buffer& buffer = program.buffers[index];
        const bool is_constant = buffer.storage == ir::Storage::Constant;
        if (used[index]) {
            kept.push_back(std::move(buffer));
        } else {
            ++report[is_constant ? "constant tables removed" : "interm-fluents removed"];
        }
    }
    program.buffers = std::move(kept);

    for (ir::Fluent& fluent : program.fluents) {
        if (!fluent.buffer) continue;
        const ir::BufferId old = *fluent.buffer;
        fluent.buffer.reset();
        if (used[old.index]) fluent.buffer = renumbered[old.index];
    }
    ir::change_buffers(program, [&](ir::BufferId& id) { id = renumbered[id.index]; });
}

}  // namespace

ir::Program remove_unused_buffers(ir::Program program, Report& report) {
    program = ir::collect_garbage(std::move(program));
    const std::vector<ir::Facts> facts = ir::all_facts(program);
    while (drop_a_definition(program, facts)) {
    }
    program = ir::collect_garbage(std::move(program));
    drop_buffers(program, report);
    return program;
}

}  // namespace rddlc::passes
