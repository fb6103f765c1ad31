#include "ground/bounds.hpp"

#include "ground/codes.hpp"
#include "ground/lowering.hpp"
#include "ir/builder.hpp"
#include "ir/evaluator.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace rddlc::grounding {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The distance by which a strict inequality moves a real bound, as in pyRDDLGym.
constexpr double strictness = 1e-5;

// `fluent(indices) op limit` for all values of the variables.
struct Constraint {
    model::FluentId fluent;
    std::vector<ir::NodeId> indices;
    Operator op;  // Less to GreaterEqual
    ir::NodeId limit;
    std::vector<ir::VariableId> variables;
    Span span;
};

bool is_numeric(const model::Fluent& fluent) {
    return fluent.range == model::int_type || fluent.range == model::real_type;
}

const model::Reference* reference_behind(const model::Expr& expr) {
    if (const auto* convert = std::get_if<model::Convert>(&expr.node)) {
        return reference_behind(*convert->operand);
    }
    return std::get_if<model::Reference>(&expr.node);
}

// Finds the constraints in conditions and lowers their sides.
class Collector {
  public:
    Collector(const model::Model& model, const ir::Builder& builder, Lowering& lowering)
        : model_(model), builder_(builder), lowering_(lowering) {}

    void collect(const model::Expr& condition, Role role) {
        if (const auto* aggregate = std::get_if<model::Aggregate>(&condition.node)) {
            if (aggregate->op == Reduction::ForAll) collect_below(*aggregate, role);
            return;
        }
        const auto* apply = std::get_if<model::Apply>(&condition.node);
        if (!apply) return;
        if (apply->op == Operator::And) {
            for (const model::Expr& half : apply->operands) collect(half, role);
        } else if (is_order(apply->op)) {
            const model::Expr& left = apply->operands.front();
            const model::Expr& right = apply->operands.back();
            add(left, apply->op, right, role, condition.span);
            add(right, mirrored(apply->op), left, role, condition.span);
        }
    }

    std::vector<Constraint> constraints() && { return std::move(constraints_); }

  private:
    void collect_below(const model::Aggregate& forall, Role role) {
        lowering_.enter(forall.variables);
        for (model::VariableId id : forall.variables) {
            variables_.push_back(lowering_.variable_of(id));
        }
        collect(*forall.body, role);
        lowering_.leave(forall.variables.size());
        variables_.resize(variables_.size() - forall.variables.size());
    }

    void add(const model::Expr& fluent_side, Operator op, const model::Expr& limit_side, Role role,
             Span span) {
        const model::Reference* reference = reference_behind(fluent_side);
        if (!reference || reference->next) return;
        const model::Fluent& fluent = model_.fluents[reference->fluent];
        if (fluent.role != role || !is_numeric(fluent)) return;

        Constraint constraint{reference->fluent,           {},         op,
                              lowering_.lower(limit_side), variables_, span};
        if (!builder_.properties(constraint.limit).uniform) return;
        for (const model::Expr& argument : reference->arguments) {
            constraint.indices.push_back(lowering_.lower(argument));
            if (!builder_.properties(constraint.indices.back()).uniform) return;
        }
        constraints_.push_back(std::move(constraint));
    }

    const model::Model& model_;
    const ir::Builder& builder_;
    Lowering& lowering_;
    std::vector<ir::VariableId> variables_;
    std::vector<Constraint> constraints_;
};

// Evaluates constraints for all values of their variables and narrows the bounds.
class Narrowing {
  public:
    // `lowered` has the constraints' nodes, `result` gets the bounds.
    Narrowing(const ir::Program& lowered, ir::Program& result, Diagnostics& diagnostics)
        : lowered_(lowered), result_(result), diagnostics_(diagnostics), evaluator_(lowered) {}

    void apply(const Constraint& constraint) {
        Context context;
        ir::Evaluator::Frame frame(evaluator_, {}, context);
        contradicted_ = false;
        for_all_values(constraint, 0, frame, context);
    }

  private:
    void for_all_values(const Constraint& constraint, std::size_t depth,
                        ir::Evaluator::Frame& frame, Context& context) {
        if (depth == constraint.variables.size()) {
            narrow(constraint, frame, context);
            return;
        }
        const ir::VariableId variable = constraint.variables[depth];
        for (std::int64_t i = 0; i < lowered_[variable].size; ++i) {
            frame.set(variable, i);
            for_all_values(constraint, depth + 1, frame, context);
        }
    }

    // A side that faults bounds nothing; the condition will fault when it is checked.
    void narrow(const Constraint& constraint, ir::Evaluator::Frame& frame, Context& context) {
        std::vector<std::int64_t> indices;
        for (ir::NodeId index : constraint.indices) {
            indices.push_back(evaluator_.value<std::int64_t>(index, frame));
        }
        const double limit = limit_of(constraint, frame);
        if (context.fault) {
            context.fault = {};
        } else if (!std::isnan(limit)) {
            narrow(constraint, indices, limit);
        }
    }

    double limit_of(const Constraint& constraint, ir::Evaluator::Frame& frame) const {
        switch (lowered_[constraint.limit].type) {
            case ir::Scalar::Bool:
                return evaluator_.value<bool>(constraint.limit, frame) ? 1 : 0;
            case ir::Scalar::Int:
                return static_cast<double>(evaluator_.value<std::int64_t>(constraint.limit, frame));
            case ir::Scalar::Real:
                return evaluator_.value<double>(constraint.limit, frame);
        }
        return infinity;
    }

    void narrow(const Constraint& constraint, const std::vector<std::int64_t>& indices,
                double limit) {
        ir::Fluent& fluent = result_.fluents[constraint.fluent];
        const std::size_t grounding = row_major(fluent, indices);
        double& lower = fluent.lower.to_change()[grounding];
        double& upper = fluent.upper.to_change()[grounding];
        const bool whole = fluent.scalar == ir::Scalar::Int;
        const bool strict = is_one_of(constraint.op, {Operator::Less, Operator::Greater});
        if (is_one_of(constraint.op, {Operator::Less, Operator::LessEqual})) {
            const double bound = strict ? (whole ? std::ceil(limit) - 1 : limit - strictness)
                                        : (whole ? std::floor(limit) : limit);
            upper = std::min(upper, bound);
        } else {
            const double bound = strict ? (whole ? std::floor(limit) + 1 : limit + strictness)
                                        : (whole ? std::ceil(limit) : limit);
            lower = std::max(lower, bound);
        }
        if (lower > upper) report_contradiction(constraint, indices, lower, upper);
    }

    // Once for each constraint.
    void report_contradiction(const Constraint& constraint,
                              const std::vector<std::int64_t>& indices, double lower,
                              double upper) {
        if (contradicted_) return;
        contradicted_ = true;
        const ir::Fluent& fluent = result_.fluents[constraint.fluent];
        diagnostics_.report({contradictory_bounds, constraint.span,
                             fmt::format("no value of '{}' satisfies the constraints: it must be "
                                         "at least {} and at most {}",
                                         grounded_name(fluent, indices), lower, upper)});
    }

    std::size_t row_major(const ir::Fluent& fluent,
                          const std::vector<std::int64_t>& indices) const {
        std::size_t offset = 0;
        for (std::size_t axis = 0; axis < indices.size(); ++axis) {
            const std::size_t size = result_.types[fluent.parameter_types[axis]].objects.size();
            offset = offset * size + static_cast<std::size_t>(indices[axis]);
        }
        return offset;
    }

    std::string grounded_name(const ir::Fluent& fluent,
                              const std::vector<std::int64_t>& indices) const {
        std::vector<std::string> objects;
        for (std::size_t axis = 0; axis < indices.size(); ++axis) {
            const ir::ObjectType& type = result_.types[fluent.parameter_types[axis]];
            objects.push_back(type.objects[static_cast<std::size_t>(indices[axis])]);
        }
        if (objects.empty()) return fluent.name;
        return fmt::format("{}({})", fluent.name, fmt::join(objects, ", "));
    }

    const ir::Program& lowered_;
    ir::Program& result_;
    Diagnostics& diagnostics_;
    ir::Evaluator evaluator_;
    bool contradicted_ = false;
};

void start_unbounded(const model::Model& model, ir::Program& program) {
    for (std::size_t id = 0; id < program.fluents.size(); ++id) {
        const model::Fluent& fluent = model.fluents[id];
        const bool may_be_bounded = fluent.role == Role::State || fluent.role == Role::Action;
        if (!may_be_bounded || !is_numeric(fluent)) continue;
        const auto count = static_cast<std::size_t>(model.grounding_count(fluent));
        program.fluents[id].lower.assign(count, -infinity);
        program.fluents[id].upper.assign(count, infinity);
    }
}

}  // namespace

void find_bounds(const model::Model& model, const std::vector<FluentBuffers>& buffers,
                 ir::Program& program, Diagnostics& diagnostics) {
    // Nodes that only bounds need go to a copy.
    ir::Program lowered = program;
    start_unbounded(model, program);
    ir::Builder builder(lowered);
    Diagnostics already_reported;
    Lowering lowering(model, buffers, lowered, builder, already_reported);
    Collector collector(model, builder, lowering);
    for (const model::Expr& condition : model.action_preconditions) {
        collector.collect(condition, Role::Action);
    }
    for (const model::Expr& condition : model.state_invariants) {
        collector.collect(condition, Role::State);
    }
    Narrowing narrowing(lowered, program, diagnostics);
    for (const Constraint& constraint : std::move(collector).constraints()) {
        narrowing.apply(constraint);
    }
}

}  // namespace rddlc::grounding
