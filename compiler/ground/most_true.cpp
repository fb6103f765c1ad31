#include "ground/most_true.hpp"

#include "ir/analysis.hpp"
#include "ir/reduction_nest.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace rddlc::grounding {
namespace {

class Finding {
  public:
    Finding(const ir::Builder& builder, ir::Program& program)
        : builder_(builder), program_(program) {}

    // The condition holds for each of so many rows of objects.
    void look_at(ir::NodeId condition, double rows) {
        const ir::Node& node = program_[condition];
        if (const auto nest = ir::reduction_nest(program_, condition)) {
            if (nest->op != Reduction::ForAll) return;
            for (const ir::VariableId variable : nest->variables)
                rows *= static_cast<double>(program_[variable].size);
            return look_at(nest->body, rows);
        }
        const auto* apply = std::get_if<ir::Apply>(&node.form);
        if (!apply) return;
        const ir::NodeId a = apply->operands.front(), b = apply->operands.back();
        if (apply->op == Operator::And) {
            look_at(a, rows);
            look_at(b, rows);
        }
        const bool is_equal = apply->op == Operator::Equal;
        if (is_equal || is_one_of(apply->op, {Operator::LessEqual, Operator::Less}))
            bound(a, b, apply->op == Operator::Less, rows);
        if (is_equal || is_one_of(apply->op, {Operator::GreaterEqual, Operator::Greater}))
            bound(b, a, apply->op == Operator::Greater, rows);
    }

    void bound_all(std::int64_t most) {
        for (ir::Buffer& buffer : program_.buffers)
            if (is_of_action(buffer)) lower(buffer, most);
    }

  private:
    // The limit of a sum bounds what each term counts, where no term may be negative.
    void bound(ir::NodeId sum, ir::NodeId limit, bool is_below, double rows) {
        const auto range = range_of(limit);
        if (!range || !std::isfinite(range->upper)) return;
        const double most = range->upper;
        std::vector<ir::NodeId> terms;
        collect_terms(sum, terms);
        const auto is_positive = [&](ir::NodeId term) {
            return is_never_negative(term);
        };
        if (most < 0 || !std::ranges::all_of(terms, is_positive)) return;
        for (const ir::NodeId term : terms) bound_term(term, most, is_below, rows);
    }

    // Ints that are so large that they wrap around do not matter here.
    bool is_never_negative(ir::NodeId id) const {
        const ir::Node& node = program_[id];
        const auto& range = range_of(id);
        if (node.type == ir::Scalar::Bool || (range && range->lower >= 0)) return true;
        const auto* apply = std::get_if<ir::Apply>(&node.form);
        const auto* reduce = std::get_if<ir::Reduce>(&node.form);
        const bool keeps_sign = apply ? is_one_of(apply->op, {Operator::Add, Operator::Multiply})
                                      : (reduce && reduce->op == Reduction::Sum) ||
                                            std::holds_alternative<ir::Convert>(node.form);
        return keeps_sign && std::ranges::all_of(ir::operands_of(node), [&](ir::NodeId operand) {
                   return is_never_negative(operand);
               });
    }

    void collect_terms(ir::NodeId id, std::vector<ir::NodeId>& terms) const {
        const ir::Node& node = program_[id];
        if (const auto* convert = std::get_if<ir::Convert>(&node.form))
            return collect_terms(convert->operand, terms);
        const auto* apply = std::get_if<ir::Apply>(&node.form);
        if (!apply || apply->op != Operator::Add) return terms.push_back(id);
        for (const ir::NodeId operand : apply->operands) collect_terms(operand, terms);
    }

    void bound_term(ir::NodeId term, double most, bool is_below, double rows) {
        const auto nest = ir::reduction_nest(program_, term);
        if (!nest || nest->op != Reduction::Sum) return;
        double weight = 1;
        const auto* const load = counted(nest->body, weight);
        if (!load || weight <= 0) return;
        ir::Buffer& buffer = program_.buffers[load->buffer.index];
        const double count = most / weight;
        const double bound = (is_below ? std::ceil(count) - 1 : std::floor(count)) * rows;
        if (is_of_action(buffer) && is_all_elements(load->indices) && bound >= 0 &&
            bound < static_cast<double>(buffer.count()))
            lower(buffer, static_cast<std::int64_t>(bound));
    }

    // Not one column, nor the diagonal.
    bool is_all_elements(const std::vector<ir::NodeId>& indices) const {
        const auto is_first_of_variable = [&](const ir::NodeId& index) {
            return std::holds_alternative<ir::Index>(program_[index].form) &&
                   std::find(indices.data(), &index, index) == &index;
        };
        return std::ranges::all_of(indices, is_first_of_variable);
    }

    // The bool that a term counts so many times; null if it is something else.
    const ir::Load* counted(ir::NodeId id, double& weight) const {
        const ir::Node& node = program_[id];
        if (const auto* convert = std::get_if<ir::Convert>(&node.form))
            return counted(convert->operand, weight);
        const auto* apply = std::get_if<ir::Apply>(&node.form);
        if (!apply || apply->op != Operator::Multiply) return std::get_if<ir::Load>(&node.form);
        const ir::Load* found = nullptr;
        for (const ir::NodeId operand : apply->operands) {
            const auto* constant = std::get_if<ir::Constant>(&program_[operand].form);
            if (constant)
                weight *= as_real(constant->value);
            else if (found)
                return nullptr;
            else
                found = counted(operand, weight);
        }
        return found;
    }

    static bool is_of_action(const ir::Buffer& buffer) {
        return buffer.storage == ir::Storage::Action && buffer.scalar == ir::Scalar::Bool;
    }
    static void lower(ir::Buffer& buffer, std::int64_t most) {
        buffer.most_true = std::min(most, buffer.most_true.value_or(most));
    }
    const std::optional<Range>& range_of(ir::NodeId id) const {
        return builder_.properties(id).range;
    }

    const ir::Builder& builder_;
    ir::Program& program_;
};

}  // namespace

void find_most_true(const ir::Builder& builder, ir::Program& program) {
    Finding finding(builder, program);
    if (program.max_nondef_actions) finding.bound_all(*program.max_nondef_actions);
    for (const ir::Computation& condition : program.preconditions)
        finding.look_at(condition.value, 1);
}

}  // namespace rddlc::grounding
