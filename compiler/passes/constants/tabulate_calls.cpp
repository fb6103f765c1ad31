#include "passes/constants/tabulate_calls.hpp"

#include "ir/call.hpp"
#include "ir/evaluation_budget.hpp"
#include "ir/evaluator.hpp"
#include "ir/layout.hpp"
#include "ir/rewrite.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// A statement of the step outside of all loops, and what it does with tables.
struct Step {
    const ir::Statement* statement;
    std::set<ir::BufferId> reads, writes, passed;  // passed to functions
    bool is_fixed;                                 // by the instance
};

class CallTabulation {
  public:
    explicit CallTabulation(const ir::Program& program)
        : program_(program), properties_(ir::all_properties(program)) {
        for (const ir::Definition& definition : program.step)
            for (const ir::Statement& statement : definition.body)
                steps_.push_back(step_of(statement));
        collect_passed(program.reward.body);
        for (const auto* conditions :
             {&program.preconditions, &program.invariants, &program.terminations})
            for (const ir::Computation& condition : *conditions) collect_passed(condition.body);
    }

    // Whether each statement of the step is fixed, and calls are among them.
    bool find_fixed() {
        while (leaves_out_some()) continue;
        return std::ranges::any_of(steps_, [](const Step& step) {
            return step.is_fixed && std::holds_alternative<ir::Call>(step.statement->form);
        });
    }

    // The values of the tables that fixed statements fill; nothing if one faults, or it takes too
    // long.
    std::optional<std::map<ir::BufferId, Table>> values() const {
        double cost = 0;
        ir::Block block;
        for (const Step& step : steps_) {
            if (!step.is_fixed) continue;
            cost += cost_of(*step.statement);
            block.push_back(*step.statement);
        }
        if (!ir::EvaluationBudget::allows(cost)) return std::nullopt;
        const ir::RecordLayout layout = ir::record_layout(program_, ir::Storage::Scratch);
        std::vector<double> room(layout.size / sizeof(double) + 1);
        auto* const scratch = reinterpret_cast<std::byte*>(room.data());
        const ir::Evaluator evaluator(program_);
        Context context;
        ir::Evaluator::Frame frame(evaluator, ir::Records().set(ir::Storage::Scratch, scratch),
                                   context);
        evaluator.run(block, frame);
        if (context.fault) return std::nullopt;

        std::map<ir::BufferId, Table> values;
        const std::set<ir::BufferId> filled = ir::written_buffers(block);
        for (const ir::Field& field : layout.fields)
            if (filled.contains(field.buffer))
                values[field.buffer] = table_at(field.buffer, scratch + field.offset);
        return values;
    }

    bool is_fixed(std::size_t step) const { return steps_[step].is_fixed; }

  private:
    void collect_passed(const ir::Block& block) {
        ir::for_each_statement<ir::Call>(block, [&](const ir::Call& call) {
            for (const ir::TableView& input : call.inputs) passed_after_.insert(input.buffer);
        });
    }

    Step step_of(const ir::Statement& statement) const {
        ir::Block block;
        block.push_back(statement);
        Step step{&statement, {}, ir::written_buffers(block), {}, true};
        ir::for_each_statement<ir::Let>(block, [&](const ir::Let&) { step.is_fixed = false; });
        ir::for_each_statement<ir::Call>(block, [&](const ir::Call& call) {
            for (const ir::TableView& input : call.inputs) step.passed.insert(input.buffer);
            step.is_fixed &= !ir::is_external(call.callee) && !ir::is_draw(call.callee);
        });
        std::set<ir::NodeId> visited;
        for (const ir::NodeId root : ir::roots_of(block)) {
            step.is_fixed &= !properties_[root.index].random;
            collect_reads(root, visited, step);
        }
        return step;
    }
    void collect_reads(ir::NodeId id, std::set<ir::NodeId>& visited, Step& step) const {
        if (!visited.insert(id).second) return;
        const ir::Node& node = program_[id];
        step.is_fixed &= !std::holds_alternative<ir::Local>(node.form);
        if (const auto buffer = ir::buffer_read_by(node)) step.reads.insert(*buffer);
        for (const ir::NodeId operand : ir::operands_of(node))
            collect_reads(operand, visited, step);
    }

    // Leaves out statements that depend on others than fixed ones, or whose tables do.
    bool leaves_out_some() {
        std::set<ir::BufferId> others;
        for (const Step& step : steps_)
            if (!step.is_fixed) others.insert(step.writes.begin(), step.writes.end());
        const auto is_known = [&](ir::BufferId id) {
            const ir::Storage storage = program_[id].storage;
            return storage == ir::Storage::Constant ||
                   (storage == ir::Storage::Scratch && !others.contains(id));
        };
        bool some = false;
        for (Step& step : steps_) {
            const bool stays = std::ranges::all_of(step.reads, is_known) &&
                               std::ranges::all_of(step.passed, is_known) &&
                               std::ranges::all_of(step.writes, is_known) &&
                               !is_passed_to_others(step);
            some |= step.is_fixed && !stays;
            step.is_fixed &= stays;
        }
        return some;
    }
    // Calls that stay need the table where it is.
    bool is_passed_to_others(const Step& filling) const {
        const auto is_filled = [&](ir::BufferId buffer) {
            return filling.writes.contains(buffer);
        };
        return std::ranges::any_of(passed_after_, is_filled) ||
               std::ranges::any_of(steps_, [&](const Step& step) {
                   return !step.is_fixed && std::ranges::any_of(step.passed, is_filled);
               });
    }

    double cost_of(const ir::Statement& statement) const {
        return match(
            statement.form, [](const ir::Let&) { return 0.0; },
            [&](const ir::Store& store) { return 1 + properties_[store.value.index].cost; },
            [&](const ir::Loop& loop) {
                double cost = 1;
                for (const ir::Statement& each : loop.body) cost += cost_of(each);
                return static_cast<double>(program_[loop.variable].size) * cost;
            },
            [](const ir::Spread&) { return 0.0; },  // later passes make them
            [](const ir::Visit&) { return 0.0; },
            [&](const ir::Call& call) {  // of a matrix
                return std::pow(static_cast<double>(program_[call.inputs.front().buffer].count()),
                                1.5);
            });
    }

    Table table_at(ir::BufferId id, const std::byte* from) const {
        std::vector<ir::Value> values;
        const auto add = [&]<class T>(T value) {
            for (std::int64_t k = 0; k < program_[id].count(); ++k) {
                std::memcpy(&value, from + static_cast<std::size_t>(k) * sizeof value,
                            sizeof value);
                values.emplace_back(value);
            }
        };
        if (program_[id].scalar == ir::Scalar::Bool) add(bool{});
        if (program_[id].scalar == ir::Scalar::Int) add(std::int64_t{});
        if (program_[id].scalar == ir::Scalar::Real) add(double{});
        return values;
    }

    const ir::Program& program_;
    std::vector<ir::Properties> properties_;
    std::vector<Step> steps_;
    std::set<ir::BufferId> passed_after_;  // to functions of the reward and of conditions
};

// A definition may be left with tables of others.
void leave_out_fixed(ir::Program& program, const CallTabulation& calls) {
    std::size_t step = 0;
    for (ir::Definition& definition : program.step) {
        ir::Block rest;
        for (ir::Statement& statement : definition.body)
            if (!calls.is_fixed(step++)) rest.push_back(std::move(statement));
        definition.body = std::move(rest);
        const std::set<ir::BufferId> written = ir::written_buffers(definition.body);
        if (!written.empty() && !written.contains(definition.target))
            definition.target = *written.begin();
    }
    std::erase_if(program.step,
                  [](const ir::Definition& definition) { return definition.body.empty(); });
}

}  // namespace

ir::Program tabulate_calls(ir::Program program, Report& report) {
    CallTabulation calls(program);
    if (!calls.find_fixed()) return program;
    const auto values = calls.values();
    if (!values) return program;
    leave_out_fixed(program, calls);
    std::map<ir::BufferId, ir::BufferId> constants;
    for (const auto& [buffer, table] : *values) {
        ir::Buffer constant = program[buffer];
        constant.storage = ir::Storage::Constant;
        constant.values = table;
        constants[buffer] = {static_cast<std::uint32_t>(program.buffers.size())};
        program.buffers.push_back(std::move(constant));
    }
    ++report["functions of tables called"];
    return ir::rewrite(
        std::move(program),
        [&](ir::Builder& builder, ir::NodeId, const ir::Node& node) -> std::optional<ir::NodeId> {
            const auto* load = std::get_if<ir::Load>(&node.form);
            const auto constant = load ? constants.find(load->buffer) : constants.end();
            if (constant == constants.end()) return std::nullopt;
            return builder.load(constant->second, load->indices);
        });
}

}  // namespace rddlc::passes
