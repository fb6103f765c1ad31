#include "passes/aggregations/factor_aggregations.hpp"

#include "ir/reduction_nest.hpp"
#include "ir/rewrite.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

using Factors = std::vector<ir::NodeId>;

// Aggregations right inside each other by the same operator, over the product of some factors;
// for bools that is their conjunction, in a forall their disjunction.
struct FactoredNest {
    Reduction op;
    std::vector<ir::VariableId> variables;
    Factors factors;
};

class Factoring {
  public:
    explicit Factoring(ir::Builder& builder) : builder_(builder) {}

    // The same value by factors taken out, if that makes some part depend on less.
    std::optional<ir::NodeId> factored(ir::NodeId id) {
        const auto nest = nest_of(id);
        if (!nest) return std::nullopt;
        FactoredNest rest = *nest;
        while (take_out_one(rest, *nest)) {
        }
        if (rest.variables.size() == nest->variables.size()) return std::nullopt;
        return ir::reduced(builder_, rest.op, rest.variables, product(rest.op, rest.factors));
    }

  private:
    std::optional<FactoredNest> nest_of(ir::NodeId id) const {
        const auto nest = ir::reduction_nest(program(), id);
        if (!nest || builder_.properties(nest->body).may_fault) return std::nullopt;
        const ir::Scalar type = program()[id].type;
        const bool is_exact =
            type == ir::Scalar::Bool || (type == ir::Scalar::Int && nest->op == Reduction::Sum);
        if (!is_exact) return std::nullopt;
        FactoredNest factored{nest->op, nest->variables, {}};
        collect_factors(nest->op, nest->body, factored.factors);
        if (factored.factors.size() < 2) return std::nullopt;
        return factored;
    }

    void collect_factors(Reduction op, ir::NodeId id, Factors& factors) const {
        const auto all = [&](const std::vector<ir::NodeId>& parts) {
            for (ir::NodeId part : parts) collect_factors(op, part, factors);
        };
        const ir::Node& node = program()[id];
        if (const auto* apply = std::get_if<ir::Apply>(&node.form)) {
            const bool splits =
                op == Reduction::Sum
                    ? apply->op == Operator::Multiply || apply->op == Operator::And
                    : apply->op == (op == Reduction::ForAll ? Operator::Or : Operator::And);
            if (splits) return all(apply->operands);
        }
        // product() makes this of a condition and a number.
        const auto* select = std::get_if<ir::Select>(&node.form);
        if (select && op == Reduction::Sum && is_zero(select->else_value)) {
            return all({select->condition, select->then_value});
        }
        const auto* convert = std::get_if<ir::Convert>(&node.form);
        if (convert) return collect_factors(op, convert->operand, factors);
        factors.push_back(id);
    }

    // Takes out one variable: the factors that depend on it become an aggregation of their own,
    // which is a factor of the others. True if some part of the nest then depends on less.
    bool take_out_one(FactoredNest& rest, const FactoredNest& whole) {
        for (auto variable = rest.variables.begin(); variable != rest.variables.end(); ++variable) {
            Factors inside, outside;
            for (ir::NodeId factor : rest.factors) {
                (depends(factor, *variable) ? inside : outside).push_back(factor);
            }
            if (inside.empty() || outside.empty() || !depend_on_less(inside, whole)) continue;
            outside.push_back(builder_.reduce(rest.op, *variable, product(rest.op, inside)));
            rest.factors = std::move(outside);
            rest.variables.erase(variable);
            return true;
        }
        return false;
    }

    // There is a variable around the nest that these factors do not depend on.
    bool depend_on_less(const Factors& inside, const FactoredNest& whole) const {
        const auto is_needed = [&](ir::VariableId variable) {
            return std::ranges::find(whole.variables, variable) != whole.variables.end() ||
                   std::ranges::any_of(inside,
                                       [&](ir::NodeId id) { return depends(id, variable); });
        };
        return std::ranges::any_of(whole.factors, [&](ir::NodeId factor) {
            return !std::ranges::all_of(builder_.properties(factor).free_variables, is_needed);
        });
    }

    ir::NodeId product(Reduction op, const Factors& factors) {
        if (op != Reduction::Sum) {
            return joined(op == Reduction::ForAll ? Operator::Or : Operator::And, factors);
        }
        Factors conditions, numbers;
        for (ir::NodeId factor : factors) {
            const bool is_bool = program()[factor].type == ir::Scalar::Bool;
            (is_bool ? conditions : numbers).push_back(factor);
        }
        if (numbers.empty()) {
            return builder_.convert(joined(Operator::And, conditions), ir::Scalar::Int);
        }
        const ir::NodeId number = joined(Operator::Multiply, numbers);
        if (conditions.empty()) return number;
        const ir::NodeId condition = joined(Operator::And, conditions);
        return builder_.select(condition, number, builder_.constant(std::int64_t{0}));
    }

    ir::NodeId joined(Operator op, const Factors& factors) {
        ir::NodeId result = factors.front();
        for (std::size_t k = 1; k < factors.size(); ++k) {
            result = builder_.apply(op, {result, factors[k]});
        }
        return result;
    }

    bool is_zero(ir::NodeId id) const {
        const auto* constant = std::get_if<ir::Constant>(&program()[id].form);
        return constant && constant->value == ir::Value(std::int64_t{0});
    }
    bool depends(ir::NodeId id, ir::VariableId variable) const {
        return ir::depends_on(builder_.properties(id), variable);
    }
    const ir::Program& program() const { return builder_.program(); }

    ir::Builder& builder_;
};

}  // namespace

ir::Program factor_aggregations(ir::Program program, Report& report) {
    return ir::rewrite(
        std::move(program),
        [&](ir::Builder& builder, ir::NodeId, const ir::Node& node) -> std::optional<ir::NodeId> {
            if (!std::holds_alternative<ir::Reduce>(node.form)) return std::nullopt;
            const auto factored = Factoring(builder).factored(builder.rebuild(node));
            if (factored) ++report["aggregations factored"];
            return factored;
        });
}

}  // namespace rddlc::passes
