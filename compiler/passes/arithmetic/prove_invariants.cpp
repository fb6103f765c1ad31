#include "passes/arithmetic/prove_invariants.hpp"

#include "ir/nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/readers.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

class Proof {
  public:
    explicit Proof(ir::Program program) : program_(std::move(program)), builder_(program_) {}

    ir::Program run(Report& report) && {
        for (ir::Computation& invariant : program_.invariants) {
            if (!invariant.body.empty() || !is_kept(invariant.value)) continue;
            invariant.value = builder_.constant(true);
            ++report["invariants proved"];
        }
        return ir::collect_garbage(std::move(program_));
    }

  private:
    // Whether the condition holds in every state that a step makes.
    bool is_kept(ir::NodeId condition) {
        const auto form = program_[condition].form;  // the builder moves nodes
        if (const auto* all = std::get_if<ir::Reduce>(&form))
            return all->op == Reduction::ForAll && is_kept(all->body);
        const auto* apply = std::get_if<ir::Apply>(&form);
        if (!apply || apply->operands.size() != 2) return false;
        const ir::NodeId a = apply->operands[0], b = apply->operands[1];
        if (apply->op == Operator::And) return is_kept(a) && is_kept(b);
        if (apply->op == Operator::LessEqual) return is_kept_at_most(a, b);
        if (apply->op == Operator::GreaterEqual) return is_kept_at_most(b, a);
        return false;
    }
    bool is_kept_at_most(ir::NodeId a, ir::NodeId b) {
        const auto lower = in_next_state(a), upper = in_next_state(b);
        return lower && upper &&
               (is_bounded(*lower, Side::AtMost, *upper) ||
                is_bounded(*upper, Side::AtLeast, *lower));
    }

    // The value of an element of the state, or of a constant, after a step. The choice of the
    // element must not depend on the state, since that is another one after the step.
    std::optional<ir::NodeId> in_next_state(ir::NodeId id) {
        if (builder_.properties(id).uniform) return id;
        const auto form = program_[id].form;
        const auto* load = std::get_if<ir::Load>(&form);
        if (!load || program_[load->buffer].storage != ir::Storage::State) return std::nullopt;
        const auto is_fixed = [&](ir::NodeId index) {
            return builder_.properties(index).uniform;
        };
        if (!std::ranges::all_of(load->indices, is_fixed)) return std::nullopt;
        const ir::Definition* definition = definition_of_next(load->buffer);
        return definition ? element(*definition, load->indices) : std::nullopt;
    }
    const ir::Definition* definition_of_next(ir::BufferId state) const {
        const auto fills = [&](const ir::Definition& definition) {
            const ir::Buffer& target = program_[definition.target];
            return target.storage == ir::Storage::Next && target.name == program_[state].name;
        };
        if (std::ranges::count_if(program_.step, fills) != 1) return nullptr;
        return &*std::ranges::find_if(program_.step, fills);
    }
    // The definition consists of loops around one statement.
    std::optional<ir::NodeId> element(const ir::Definition& definition,
                                      const std::vector<ir::NodeId>& indices) {
        const ir::Block* body = &definition.body;
        std::vector<ir::VariableId> variables;
        if (const auto* loop = ir::only_statement<ir::Loop>(*body)) {
            ir::Nest nest = ir::nest_of(*loop);
            variables = std::move(nest.variables);
            body = nest.body;
        }
        const auto* store = ir::only_statement<ir::Store>(*body);
        if (!store || variables.size() != indices.size()) return std::nullopt;
        const std::set<ir::VariableId> bound = bound_variables(program_, store->value);
        const auto is_bound_there = [&](ir::VariableId variable) {
            return bound.contains(variable);
        };
        std::map<ir::NodeId, ir::NodeId> known;
        for (std::size_t k = 0; k < indices.size(); ++k) {
            if (store->indices[k] != builder_.index(variables[k])) return std::nullopt;
            if (std::ranges::any_of(builder_.properties(indices[k]).free_variables, is_bound_there))
                return std::nullopt;
            known[store->indices[k]] = indices[k];
        }
        return ir::replace_in(builder_, store->value, known);
    }

    enum class Side { AtMost, AtLeast };

    // Where no value is nan.
    bool is_bounded(ir::NodeId value, Side side, ir::NodeId limit) const {
        if (value == limit || is_within_range(value, side, limit)) return true;
        const auto* apply = std::get_if<ir::Apply>(&program_[value].form);
        if (!apply) return false;
        const auto is_operand_bounded = [&](ir::NodeId operand) {
            return is_bounded(operand, side, limit);
        };
        const bool is_upper = side == Side::AtMost;
        if (apply->op == (is_upper ? Operator::Minimum : Operator::Maximum))
            return std::ranges::any_of(apply->operands, is_operand_bounded);
        if (apply->op == (is_upper ? Operator::Maximum : Operator::Minimum))
            return std::ranges::all_of(apply->operands, is_operand_bounded);
        return false;
    }
    bool is_within_range(ir::NodeId value, Side side, ir::NodeId limit) const {
        const auto &range = builder_.properties(value).range,
                   &limits = builder_.properties(limit).range;
        if (!range || !limits) return false;
        return side == Side::AtMost ? range->upper <= limits->lower : range->lower >= limits->upper;
    }

    ir::Program program_;
    ir::Builder builder_;
};

}  // namespace

ir::Program prove_invariants(ir::Program program, Report& report) {
    return Proof(std::move(program)).run(report);
}

}  // namespace rddlc::passes
