#include "passes/analyses/needed_angles.hpp"

#include "ir/analysis.hpp"
#include "ir/call.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>
#include <variant>

namespace rddlc::passes {

class NeededAngles::Search {
  public:
    Search(const ir::Program& program, ir::Builder& builder)
        : program_(program), builder_(builder) {}

    void visit(const ir::Block& block) {
        for (const ir::Statement& statement : block) {
            match(
                statement.form, [&](const ir::Let& let) { visit(let.value); },
                [&](const ir::Store& store) { visit(store.value); },
                [&](const ir::Spread& spread) { visit(spread.bits); },
                [&](const ir::Loop& loop) {
                    if (program_[loop.variable].size > 0) visit(loop.body);
                },
                [](const ir::Visit&) {}, [](const ir::Call&) {});
        }
    }
    void visit(ir::NodeId id) {
        if (!seen_.insert(id).second) return;
        const ir::Node& node = program_[id];
        const std::vector<ir::NodeId> operands = ir::operands_of(node);
        if (ir::is_sine_or_cosine(node) && is_ready(id, operands.front())) {
            found_.push_back(id);
            return;
        }
        const std::size_t always = evaluates_first_alone(node) ? 1 : operands.size();
        for (std::size_t k = 0; k < always; ++k) visit(operands[k]);
    }
    std::vector<ir::NodeId> found() && { return std::move(found_); }

  private:
    bool is_ready(ir::NodeId id, ir::NodeId angle) {
        const ir::Properties& properties = builder_.properties(id);
        return !properties.random && !properties.may_fault && !properties.uniform &&
               reads_records_alone(angle);
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

    const ir::Program& program_;
    ir::Builder& builder_;
    std::set<ir::NodeId> seen_;
    std::vector<ir::NodeId> found_;
};

std::vector<ir::NodeId> NeededAngles::of(const ir::Block& block) const {
    Search search(program_, builder_);
    search.visit(block);
    return std::move(search).found();
}

std::vector<ir::NodeId> NeededAngles::of(const ir::Computation& computation) const {
    Search search(program_, builder_);
    search.visit(computation.body);
    search.visit(computation.value);
    return std::move(search).found();
}

}  // namespace rddlc::passes
