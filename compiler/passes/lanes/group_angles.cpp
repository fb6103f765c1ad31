#include "passes/lanes/group_angles.hpp"

#include "ir/analysis.hpp"
#include "ir/builder.hpp"
#include "ir/call.hpp"
#include "ir/rewrite.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// A register takes about as long as two angles one after the other.
constexpr std::size_t fewest_angles = 3;
// The most angles of one call: more would not fit into registers.
constexpr std::size_t most_together = 16;

class Grouping {
  public:
    Grouping(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        for (const ir::Definition& definition : program_.step) collect(definition.body);
        collect(program_.reward.body);
        collect(program_.reward.value);
        if (angles_.size() < fewest_angles) return std::move(program_);
        replace();
        return ir::collect_garbage(std::move(program_));
    }

  private:
    // ------------------------------------------------------------------------------ finding

    void collect(const ir::Block& block) {
        for (const ir::Statement& statement : block) {
            match(
                statement.form, [&](const ir::Let& let) { collect(let.value); },
                [&](const ir::Store& store) { collect(store.value); },
                [&](const ir::Spread& spread) { collect(spread.bits); },
                [&](const ir::Loop& loop) {
                    if (program_[loop.variable].size > 0) collect(loop.body);
                },
                [](const ir::Visit&) {}, [](const ir::Call&) {});
        }
    }
    void collect(ir::NodeId id) {
        if (!seen_.insert(id).second) return;
        const ir::Node& node = program_[id];
        const std::vector<ir::NodeId> operands = ir::operands_of(node);
        if (ir::is_sine_or_cosine(node) && is_ready(id, operands.front())) {
            found_.push_back(id);
            angles_.insert(operands.front());
            return;
        }
        const std::size_t always = evaluates_first_alone(node) ? 1 : operands.size();
        for (std::size_t k = 0; k < always; ++k) collect(operands[k]);
    }

    bool is_ready(ir::NodeId id, ir::NodeId angle) {
        const ir::Properties& properties = builder_.properties(id);
        return properties.free_variables.empty() && !properties.random && !properties.may_fault &&
               !properties.uniform && reads_records_alone(angle);
    }
    // The state, the action and constants; no sine or cosine, which may be one of the same call.
    bool reads_records_alone(ir::NodeId id) const {
        const ir::Node& node = program_[id];
        const auto buffer = ir::buffer_read_by(node);
        if (ir::is_sine_or_cosine(node) || std::holds_alternative<ir::Local>(node.form) ||
            (buffer && !is_record(program_[*buffer].storage)))
            return false;
        return std::ranges::all_of(ir::operands_of(node), [&](ir::NodeId operand) {
            return reads_records_alone(operand);
        });
    }
    static bool is_record(ir::Storage storage) {
        return storage == ir::Storage::Constant || storage == ir::Storage::State ||
               storage == ir::Storage::Action;
    }
    // The other operands may be left out.
    bool evaluates_first_alone(const ir::Node& node) const {
        const auto* select = std::get_if<ir::Select>(&node.form);
        const auto* apply = std::get_if<ir::Apply>(&node.form);
        const auto* reduce = std::get_if<ir::Reduce>(&node.form);
        return (select && !ir::is_guarded_product(program_, *select)) ||
               (apply && is_one_of(apply->op, {Operator::And, Operator::Or, Operator::Implies})) ||
               (reduce && (reduce->bounds || reduce->over_true));
    }

    // ---------------------------------------------------------------------------- replacing

    void replace() {
        if (found_.size() % most_together < fewest_angles)
            found_.resize(found_.size() - found_.size() % most_together);
        std::map<ir::NodeId, ir::NodeId> known;
        std::vector<ir::Definition> calls;
        for (std::size_t first = 0; first < found_.size(); first += most_together) {
            const std::size_t count = std::min(most_together, found_.size() - first);
            calls.push_back(together({&found_[first], &found_[first] + count}, known));
        }
        report_["sines and cosines computed together"] += std::ssize(found_);
        const ir::Change change = [&](ir::NodeId& root) {
            root = ir::replace_in(builder_, root, known);
        };
        for (ir::Definition& definition : program_.step) ir::change_roots(definition.body, change);
        ir::change_roots(program_.reward.body, change);
        change(program_.reward.value);
        program_.step.insert(program_.step.begin(), calls.begin(), calls.end());
    }

    ir::Definition together(const std::vector<ir::NodeId>& functions,
                            std::map<ir::NodeId, ir::NodeId>& known) {
        const Span span = program_.step.empty() ? program_.reward.span : program_.step[0].span;
        const ir::BufferId table =
            builder_.tables().add({.name = builder_.tables().unused_name("angles"),
                                   .storage = ir::Storage::Scratch,
                                   .scalar = ir::Scalar::Real,
                                   .shape = {std::ssize(functions)},
                                   .span = span});
        for (std::size_t k = 0; k < functions.size(); ++k)
            known[functions[k]] =
                builder_.load(table, {builder_.constant(static_cast<std::int64_t>(k))});
        return {table, {{ir::Call{ir::Together{}, {}, functions, {table, {}}, {}}}}, span};
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    std::set<ir::NodeId> seen_;
    std::vector<ir::NodeId> found_;  // in the order of their first users
    std::set<ir::NodeId> angles_;    // theirs
};

}  // namespace

ir::Program group_angles(ir::Program program, Report& report) {
    return Grouping(std::move(program), report).run();
}

}  // namespace rddlc::passes
