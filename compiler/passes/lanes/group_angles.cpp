#include "passes/lanes/group_angles.hpp"

#include "ir/analysis.hpp"
#include "ir/builder.hpp"
#include "ir/call.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/needed_angles.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// A register takes about as long as two angles one after the other, among other work of a step.
constexpr std::size_t fewest_angles = 3;
// A condition waits for the new state, and all that comes after the step waits for it.
constexpr std::size_t fewest_in_condition = 2;
// The most angles of one call: more would not fit into registers.
constexpr std::size_t most_together = 16;

class Grouping {
  public:
    Grouping(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        const NeededAngles needed(program_, builder_);
        for (const ir::Definition& definition : program_.step) collect(needed.of(definition.body));
        collect(needed.of(program_.reward));
        if (angles_.size() >= fewest_angles) replace();
        for (auto* conditions : {&program_.terminations, &program_.invariants})
            for (ir::Computation& condition : *conditions) group_in(condition);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    // The functions of a condition have a table of their own, since the engine asks for conditions
    // after the step.
    void group_in(ir::Computation& condition) {
        seen_.clear();
        found_.clear();
        angles_.clear();
        collect(NeededAngles(program_, builder_).of(condition));
        if (angles_.size() < fewest_in_condition || found_.size() > most_together) return;
        std::map<ir::NodeId, ir::NodeId> known;
        ir::Definition call = together(found_, condition.span, known);
        report_["sines and cosines computed together"] += std::ssize(found_);
        const auto replace = [&](ir::NodeId& root) {
            root = ir::replace_in(builder_, root, known);
        };
        ir::change_roots(condition.body, replace);
        replace(condition.value);
        condition.body.insert(condition.body.begin(), call.body.begin(), call.body.end());
    }

    void collect(const std::vector<ir::NodeId>& functions) {
        for (const ir::NodeId id : functions) {
            if (!builder_.properties(id).free_variables.empty() || !seen_.insert(id).second)
                continue;
            found_.push_back(id);
            angles_.insert(ir::operands_of(program_[id]).front());
        }
    }

    // ---------------------------------------------------------------------------- replacing

    void replace() {
        if (found_.size() % most_together < fewest_angles)
            found_.resize(found_.size() - found_.size() % most_together);
        std::map<ir::NodeId, ir::NodeId> known;
        std::vector<ir::Definition> calls;
        for (std::size_t first = 0; first < found_.size(); first += most_together) {
            const std::size_t count = std::min(most_together, found_.size() - first);
            const Span span = program_.step.empty() ? program_.reward.span : program_.step[0].span;
            calls.push_back(together({&found_[first], &found_[first] + count}, span, known));
        }
        report_["sines and cosines computed together"] += std::ssize(found_);
        ir::replace_in_step(builder_, program_, known);
        program_.step.insert(program_.step.begin(), calls.begin(), calls.end());
    }

    ir::Definition together(const std::vector<ir::NodeId>& functions, Span span,
                            std::map<ir::NodeId, ir::NodeId>& known) {
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
