#include "details/make_details.hpp"

#include "ir/analysis.hpp"
#include "ir/builder.hpp"
#include "ir/call.hpp"
#include "ir/fill_table.hpp"
#include "ir/reduction_nest.hpp"
#include "passes/aggregations/fuse_interm_fluents.hpp"
#include "passes/aggregations/make_aggregations_sparse.hpp"
#include "passes/lanes/choose_evaluation.hpp"
#include "passes/sharing/remove_unused_buffers.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace rddlc {
namespace {

using ir::BufferId;

bool is_detail(Role role) {
    return role == Role::Interm || role == Role::Derived;
}

std::set<BufferId> read_buffers(const ir::Program& program, const ir::Block& block) {
    std::set<BufferId> read;
    std::vector<ir::NodeId> waiting = ir::roots_of(block);
    std::set<ir::NodeId> seen;
    while (!waiting.empty()) {
        const ir::NodeId id = waiting.back();
        waiting.pop_back();
        if (!seen.insert(id).second) continue;
        if (const auto buffer = ir::buffer_read_by(program[id])) read.insert(*buffer);
        std::ranges::copy(ir::operands_of(program[id]), std::back_inserter(waiting));
    }
    ir::for_each_statement<ir::Call>(block, [&](const ir::Call& call) {
        for (const ir::TableView& input : call.inputs) read.insert(input.buffer);
    });
    return read;
}

// Keeps the definitions of interm- and derived-fluents, and of what they read.
void keep_details(ir::Program& program) {
    std::set<BufferId> wanted;
    for (const ir::Fluent& fluent : program.fluents)
        if (is_detail(fluent.role) && fluent.buffer) wanted.insert(*fluent.buffer);
    std::vector<ir::Definition> kept;
    for (auto each = program.step.rbegin(); each != program.step.rend(); ++each) {
        const std::set<BufferId> written = ir::written_buffers(each->body);
        if (std::ranges::none_of(written, [&](BufferId id) { return wanted.contains(id); }))
            continue;
        wanted.merge(read_buffers(program, each->body));
        kept.push_back(std::move(*each));
    }
    std::ranges::reverse(kept);
    program.step = std::move(kept);
}

// Next states and observations are unused here, and there are no episodes.
void forget_the_rest(ir::Program& program) {
    for (ir::Buffer& buffer : program.buffers)
        if (buffer.storage == ir::Storage::Next || buffer.storage == ir::Storage::Observation ||
            buffer.storage == ir::Storage::Memory || buffer.storage == ir::Storage::NextMemory)
            buffer.storage = ir::Storage::Scratch;
    program.policy.reset();
    program.reset.clear();
    program.invariants.clear();
    program.terminations.clear();
    program.reward = {{}, ir::Builder(program).constant(0.0), program.reward.span};
    program.real = RealType::Double;
}

class DetailsBuilder {
  public:
    explicit DetailsBuilder(ir::Program& program) : program_(program), builder_(program) {}

    void show(ir::Fluent& fluent) {
        const BufferId source = *fluent.buffer;
        ir::Buffer buffer = program_[source];
        buffer.storage = ir::Storage::Observation;
        fluent.buffer = add(std::move(buffer));
        std::vector<ir::VariableId> variables;
        for (const std::uint32_t type : fluent.parameter_types)
            variables.push_back(variable_over(type));
        const std::vector<ir::NodeId> places = indices(variables);
        fill(*fluent.buffer, variables, builder_.load(source, places), {}, span_of(source));
    }

    // The variables of its table.
    std::vector<ir::VariableId> show(const ir::Computation& condition) {
        std::int64_t entries = 1;
        ir::Buffer buffer{.name = "precondition",
                          .storage = ir::Storage::Observation,
                          .scalar = ir::Scalar::Bool,
                          .span = condition.span};
        const auto nest = ir::reduction_nest(program_, condition.value, [&](const ir::Reduce& all) {
            const ir::Variable& variable = program_[all.variable];
            if (all.op != Reduction::ForAll || !variable.type ||
                variable.size > most_condition_entries / entries)
                return false;
            entries *= variable.size;
            buffer.shape.push_back(variable.size);
            buffer.types.push_back(*variable.type);
            return true;
        });
        const auto scope = nest ? nest->variables : std::vector<ir::VariableId>{};
        fill(add(std::move(buffer)), scope, nest ? nest->body : condition.value, condition.body,
             condition.span);
        return scope;
    }

  private:
    BufferId add(ir::Buffer buffer) {
        program_.buffers.push_back(std::move(buffer));
        return {static_cast<std::uint32_t>(program_.buffers.size() - 1)};
    }
    ir::VariableId variable_over(std::uint32_t type) {
        const ir::ObjectType& objects = program_.types[type];
        program_.variables.push_back(
            {.name = objects.name.substr(0, 1), .type = type, .size = std::ssize(objects.objects)});
        return {static_cast<std::uint32_t>(program_.variables.size() - 1)};
    }
    std::vector<ir::NodeId> indices(const std::vector<ir::VariableId>& variables) {
        std::vector<ir::NodeId> nodes;
        for (const ir::VariableId variable : variables) nodes.push_back(builder_.index(variable));
        return nodes;
    }
    // The place of the CPF.
    Span span_of(BufferId source) const {
        return std::ranges::find(program_.step, source, &ir::Definition::target)->span;
    }
    void fill(BufferId target, const std::vector<ir::VariableId>& variables, ir::NodeId value,
              ir::Block before, Span span) {
        ir::Block body = std::move(before);
        ir::fill_table(builder_, body, target, variables, value);
        program_.step.push_back({target, std::move(body), span});
    }

    ir::Program& program_;
    ir::Builder builder_;
};

// The buffers of the tables, which are behind all fluents.
void number_tables(ir::Details& details) {
    auto table = details.preconditions.begin();
    const std::vector<ir::Buffer>& buffers = details.program.buffers;
    for (std::uint32_t index = 0; index < buffers.size(); ++index)
        if (buffers[index].storage == ir::Storage::Observation && !buffers[index].fluent)
            (table++)->holds = {index};
}

// Passes that need to know nothing of the rest of the program: what does not pay in text, or would
// need room for dense tables, is avoided, and no more.
ir::Program tidied(ir::Program program) {
    passes::Report unused;
    program = passes::fuse_interm_fluents(std::move(program), unused);
    program = passes::make_aggregations_sparse(std::move(program), unused);
    program = passes::remove_unused_buffers(std::move(program), unused);
    return passes::choose_evaluation(std::move(program), unused);
}

}  // namespace

ir::Details make_details(ir::Program program) {
    program.moderate.reset();
    ir::Details details;
    std::vector<ir::Computation> preconditions = std::exchange(program.preconditions, {});
    keep_details(program);
    forget_the_rest(program);
    {
        DetailsBuilder builder(program);
        for (ir::Fluent& fluent : program.fluents)
            if (is_detail(fluent.role) && fluent.buffer) builder.show(fluent);
        for (const ir::Computation& condition : preconditions)
            details.preconditions.push_back({.holds = {}, .scope = builder.show(condition)});
    }
    details.program = tidied(std::move(program));
    number_tables(details);
    return details;
}

}  // namespace rddlc
