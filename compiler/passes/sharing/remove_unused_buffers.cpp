#include "passes/sharing/remove_unused_buffers.hpp"

#include "ir/analysis.hpp"
#include "ir/call.hpp"
#include "ir/rewrite.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

bool is_seen_by_others(ir::Storage storage) {
    return storage != ir::Storage::Constant && storage != ir::Storage::Scratch;
}

// Finds the statements that the program needs, from the last one to the first, because what only
// an unneeded one reads is not needed either. A definition may fill tables that later ones read, so
// each statement is judged by itself.
class Pruning {
  public:
    explicit Pruning(ir::Program& program)
        : program_(program),
          properties_(ir::all_properties(program)),
          is_needed_(program.buffers.size()),
          is_named_(program.local_count),
          reached_(program.nodes.size()) {
        for (std::size_t index = 0; index < is_needed_.size(); ++index)
            is_needed_[index] = is_seen_by_others(program.buffers[index].storage);
    }

    void run() {
        for (auto* conditions :
             {&program_.preconditions, &program_.invariants, &program_.terminations}) {
            for (ir::Computation& condition : *conditions) prune(condition);
        }
        prune(program_.reward);
        prune(program_.step);
        if (program_.policy) prune(program_.policy->act);
        prune(program_.reset);
    }

  private:
    void prune(std::vector<ir::Definition>& definitions) {
        for (auto definition = definitions.rbegin(); definition != definitions.rend(); ++definition)
            prune(*definition);
        std::erase_if(definitions,
                      [](const ir::Definition& definition) { return definition.body.empty(); });
    }

    // The rest of an unread fluent may be a table that other definitions read.
    void prune(ir::Definition& definition) {
        prune(definition.body);
        const std::set<ir::BufferId> written = ir::written_buffers(definition.body);
        if (!written.empty() && !written.contains(definition.target))
            definition.target = *written.begin();
    }

    void prune(ir::Computation& computation) {
        reach(computation.value);
        prune(computation.body);
    }

    void prune(ir::Block& block) {
        for (std::size_t k = block.size(); k-- > 0;) {
            if (!is_needed(block[k])) block.erase(block.begin() + static_cast<std::ptrdiff_t>(k));
        }
    }

    bool is_needed(ir::Statement& statement) {
        if (auto* loop = std::get_if<ir::Loop>(&statement.form)) {
            prune(loop->body);
            return !loop->body.empty();
        }
        if (auto* visit = std::get_if<ir::Visit>(&statement.form))
            std::erase_if(visit->marks,
                          [&](const ir::Mark& mark) { return !is_needed_[mark.target.index]; });
        const bool is_needed = match(
            statement.form, [&](const ir::Let& let) { return bool{is_named_[let.local.index]}; },
            [&](const ir::Store& store) { return bool{is_needed_[store.target.index]}; },
            [&](const ir::Spread& spread) { return bool{is_needed_[spread.target.index]}; },
            [](const ir::Loop&) { return true; },
            [](const ir::Visit& visit) { return !visit.marks.empty(); },
            [&](const ir::Call& call) {
                return is_needed_[call.output.buffer.index] || ir::is_draw(call.callee);
            });
        const std::vector<ir::NodeId> roots = ir::roots_of(statement);
        const bool may_fault = std::ranges::any_of(
            roots, [&](ir::NodeId root) { return properties_[root.index].may_fault; });
        if (!is_needed && !may_fault) return false;
        for (const ir::NodeId root : roots) reach(root);
        if (const auto* visit = std::get_if<ir::Visit>(&statement.form); visit && visit->entries)
            is_needed_[visit->entries->rows.index] = true;
        if (const auto* call = std::get_if<ir::Call>(&statement.form)) {
            for (const ir::TableView& input : call->inputs) is_needed_[input.buffer.index] = true;
        }
        return true;
    }

    // Everything below is evaluated.
    void reach(ir::NodeId root) {
        std::vector<ir::NodeId> waiting = {root};
        while (!waiting.empty()) {
            const ir::NodeId id = waiting.back();
            waiting.pop_back();
            if (reached_[id.index]) continue;
            reached_[id.index] = true;
            const ir::Node& node = program_[id];
            if (const auto buffer = ir::buffer_read_by(node)) is_needed_[buffer->index] = true;
            if (const auto* local = std::get_if<ir::Local>(&node.form))
                is_named_[local->local.index] = true;
            std::ranges::copy(ir::operands_of(node), std::back_inserter(waiting));
        }
    }

    ir::Program& program_;
    std::vector<ir::Properties> properties_;
    std::vector<bool> is_needed_;  // by BufferId::index
    std::vector<bool> is_named_;   // by LocalId::index: something needed reads the local value
    std::vector<bool> reached_;    // by NodeId::index
};

// Buffers that an evaluated expression reads, that such a statement fills, or that are part of a
// record. By BufferId::index.
std::vector<bool> used_buffers(const ir::Program& program) {
    std::vector<bool> used;
    for (const ir::Buffer& buffer : program.buffers)
        used.push_back(is_seen_by_others(buffer.storage));
    const std::vector<bool> reachable = ir::reachable_nodes(program);
    for (std::size_t index = 0; index < program.nodes.size(); ++index) {
        const auto buffer = ir::buffer_read_by(program.nodes[index]);
        if (buffer && reachable[index]) used[buffer->index] = true;
    }
    for (const ir::Block* block : ir::blocks_of(program)) {
        for (const ir::BufferId written : ir::written_buffers(*block)) used[written.index] = true;
        ir::for_each_statement<ir::Loop>(*block, [&](const ir::Loop& loop) {
            if (loop.affected)
                used[loop.affected->rows.index] = used[loop.affected->objects.index] = true;
            if (loop.affected && loop.affected->moves)
                used[loop.affected->moves->table.index] = true;
            if (loop.clearances) used[loop.clearances->table.index] = true;
        });
        ir::for_each_statement<ir::Visit>(*block, [&](const ir::Visit& visit) {
            if (visit.entries) used[visit.entries->rows.index] = true;
        });
        ir::for_each_statement<ir::Call>(*block, [&](const ir::Call& call) {
            for (const ir::TableView& input : call.inputs) used[input.buffer.index] = true;
        });
    }
    return used;
}

// Removes buffers that are neither read nor written and renumbers the others.
void drop_buffers(ir::Program& program, Report& report) {
    const std::vector<bool> used = used_buffers(program);
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
    Pruning(program).run();
    program = ir::collect_garbage(std::move(program));
    drop_buffers(program, report);
    return program;
}

}  // namespace rddlc::passes
