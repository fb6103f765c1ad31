#include "rollouts/explain_condition.hpp"

#include "ir/analysis.hpp"
#include "ir/layout.hpp"
#include "support/match.hpp"

#include <rddl/interface/fault_text.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace rddlc::workbench {

namespace {

using ir::NodeId;

// More of them do not help; the last is followed by "...".
constexpr std::size_t most_values = 12;

// Walks down from a condition to the part that is to blame, and gathers the values in it.
class Explainer {
  public:
    Explainer(const ir::Program& program, const ir::Evaluator& evaluator, ir::Records records,
              Context& context)
        : program_(program),
          evaluator_(evaluator),
          context_(context),
          scratch_(ir::record_layout(program, ir::Storage::Scratch).size),
          frame_(evaluator, records.set(ir::Storage::Scratch, scratch_.data()), context) {}

    std::optional<Explanation> explain(const ir::Computation& condition) {
        evaluator_.run(condition.body, frame_);
        if (context_.fault)
            explanation_.fault = fault_text();
        else if (fails(condition.value, true))
            descend(condition.value, true);
        else
            return std::nullopt;
        return std::move(explanation_);
    }

  private:
    // ------------------------------------------------------------------------ finding the culprit

    // The node is not what is wanted, or faults.
    void descend(NodeId id, bool wanted) {
        match(
            program_[id].form, [&](const ir::Apply& form) { descend(form, id, wanted); },
            [&](const ir::Reduce& form) { descend(form, id, wanted); },
            [&](const ir::Select& form) { descend(form, id, wanted); },
            [&](const auto&) { blame(id); });
    }

    void descend(const ir::Apply& form, NodeId id, bool wanted) {
        const NodeId left = form.operands.front(), right = form.operands.back();
        if (form.op == Operator::Not) return descend(left, !wanted);
        const Operator strict = wanted ? Operator::And : Operator::Or;
        const Operator lenient = wanted ? Operator::Or : Operator::And;
        if (form.op == strict) return descend(fails(left, wanted) ? left : right, wanted);
        if (form.op == lenient) {
            descend(left, wanted);
            return descend(right, wanted);
        }
        if (form.op == Operator::Implies && wanted) {
            collect(left);
            return descend(right, true);
        }
        blame(id);
    }

    void descend(const ir::Reduce& form, NodeId id, bool wanted) {
        if (form.op != (wanted ? Reduction::ForAll : Reduction::Exists)) return blame(id);
        const ir::Variable& variable = program_[form.variable];
        for (std::int64_t i = 0; i < variable.size; ++i) {
            frame_.set(form.variable, i);
            if (!fails(form.body, wanted)) continue;
            explanation_.bindings.push_back(
                fmt::format("?{} = {}", variable.name, object_name(*variable.type, i)));
            return descend(form.body, wanted);
        }
    }

    // `a ^ b` of a `b` that may fault is "b if a, else false".
    void descend(const ir::Select& form, NodeId id, bool wanted) {
        const std::optional<bool> condition = value_of<bool>(form.condition);
        if (!condition) return blame(id);
        const NodeId taken = *condition ? form.then_value : form.else_value;
        if (std::holds_alternative<ir::Constant>(program_[taken].form))
            return descend(form.condition, !*condition);
        collect(form.condition);
        descend(taken, wanted);
    }

    bool fails(NodeId id, bool wanted) {
        const std::optional<bool> value = value_of<bool>(id);
        return !value || *value != wanted;
    }

    // Nothing if it faults.
    template <class T>
    std::optional<T> value_of(NodeId id) {
        context_.fault = {};
        const T value = evaluator_.value<T>(id, frame_);
        if (context_.fault) return std::nullopt;
        return value;
    }

    void blame(NodeId id) {
        if (!value_of<bool>(id)) explanation_.fault = fault_text();
        collect(id);
    }

    std::string fault_text() const {
        const rddl::FaultRecord& fault = context_.fault;
        const std::string& what = program_.sites[fault.place.site].what;
        const bool told_whole =
            fault.kind == rddl::FaultKind::Type || fault.kind == rddl::FaultKind::Undefined;
        if (told_whole) return what;
        return fmt::format("{}'s {}", what, rddl::requirement_of(fault.kind));
    }

    // ----------------------------------------------------------------------- gathering the values

    bool full() const { return explanation_.values.size() > most_values; }

    void collect(NodeId id) {
        if (full()) return;
        match(
            program_[id].form, [&](const ir::Load& form) { collect(form, id); },
            [&](const ir::Reduce& form) { collect(form); },
            [&](const ir::DiscreteOver& form) {
                collect_all(form.variable, form.weight, Terms::All);
            },
            [&](const ir::Select& form) {
                collect(form.condition);
                const bool condition = value_of<bool>(form.condition).value_or(false);
                collect(condition ? form.then_value : form.else_value);
            },
            [&](const auto&) {
                for (const NodeId operand : ir::operands_of(program_[id])) collect(operand);
            });
    }

    enum class Terms { All, NonZero };

    // The terms of a sum that are zero are of interest only where all are.
    void collect(const ir::Reduce& form) {
        const std::size_t before = explanation_.values.size();
        if (form.op == Reduction::Sum) collect_all(form.variable, form.body, Terms::NonZero);
        if (explanation_.values.size() == before) collect_all(form.variable, form.body, Terms::All);
    }

    void collect_all(ir::VariableId variable, NodeId body, Terms terms) {
        for (std::int64_t i = 0; i < program_[variable].size && !full(); ++i) {
            frame_.set(variable, i);
            if (terms == Terms::All || !is_zero(body)) collect(body);
        }
    }

    bool is_zero(NodeId id) {
        return program_[id].type == ir::Scalar::Real ? value_of<double>(id) == 0.0
                                                     : value_of<std::int64_t>(id) == 0;
    }

    void collect(const ir::Load& form, NodeId id) {
        for (const NodeId index : form.indices) collect(index);
        const ir::Buffer& buffer = program_[form.buffer];
        if (!buffer.fluent) return;  // a table that the user has not written
        std::vector<std::string> objects;
        for (std::size_t axis = 0; axis < form.indices.size(); ++axis)
            objects.push_back(object_name(
                buffer.types[axis], evaluator_.value<std::int64_t>(form.indices[axis], frame_)));
        std::string text = buffer.name;
        if (!objects.empty()) text += fmt::format("({})", fmt::join(objects, ", "));
        text += " = " + value_text(id, buffer);
        std::vector<std::string>& values = explanation_.values;
        if (!full() && std::find(values.begin(), values.end(), text) == values.end())
            values.push_back(values.size() < most_values ? std::move(text) : "...");
    }

    std::string value_text(NodeId id, const ir::Buffer& buffer) {
        if (buffer.scalar == ir::Scalar::Bool)
            return evaluator_.value<bool>(id, frame_) ? "true" : "false";
        if (buffer.scalar == ir::Scalar::Real) {
            char text[32];
            rddl::FixedText(text) << evaluator_.value<double>(id, frame_);
            return text;
        }
        const auto value = evaluator_.value<std::int64_t>(id, frame_);
        const auto type = program_.fluents[*buffer.fluent].object_type;
        return type ? object_name(*type, value) : std::to_string(value);
    }

    std::string object_name(std::uint32_t type, std::int64_t value) const {
        return program_.types[type].objects[static_cast<std::size_t>(value)];
    }

    const ir::Program& program_;
    const ir::Evaluator& evaluator_;
    Context& context_;
    std::vector<std::byte> scratch_;
    ir::Evaluator::Frame frame_;
    Explanation explanation_;
};

}  // namespace

std::string Explanation::text() const {
    std::string text;
    if (!bindings.empty()) text = fmt::format("at {}", fmt::join(bindings, ", "));
    if (!values.empty())
        text += fmt::format("{}{}", text.empty() ? "where " : ": ", fmt::join(values, ", "));
    if (!fault.empty()) text += fmt::format("{}{}", text.empty() ? "" : "; ", fault);
    return text;
}

std::optional<Explanation> explain_condition(const ir::Program& program,
                                             const ir::Evaluator& evaluator,
                                             const ir::Computation& condition, ir::Records records,
                                             const Context& context) {
    Context own = context;
    return Explainer(program, evaluator, records, own).explain(condition);
}

}  // namespace rddlc::workbench
