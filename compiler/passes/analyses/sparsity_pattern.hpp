// The objects for which an expression may differ from a given value, as far as constant tables
// decide that.
//
//     LINK[x, y] && state.up[y]      differs from false only for (x, y) in LINK
//     COST[x] * real(state.up[x])    differs from 0 only for x with a cost
//     RATE[x, state.mode]            differs from 0 only for x with a rate in some mode
//
// The work goes with the entries of the tables that are exceptions, not with the number of objects.
#pragma once

#include "ir/builder.hpp"
#include "ir/evaluation_budget.hpp"
#include "ir/evaluator.hpp"
#include "ir/ir.hpp"
#include "passes/analyses/relation.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rddlc::passes {

class SparsityPattern {
  public:
    // Both must outlive this. The evaluator is of the builder's program; nodes may be added later.
    SparsityPattern(const ir::Builder& builder, const ir::Evaluator& evaluator);

    // The assignments outside of which evaluating the node gives `value` and no fault; a zero may
    // have either sign. Nothing if no useful bound is known.
    std::optional<Relation> of(ir::NodeId id, const ir::Value& value);

    // The assignments outside of which a term of a sum is a zero if each of the factors that are
    // added to `doubtful` is finite, and nan if one is not. Nothing if no useful bound is known.
    std::optional<Relation> of_term(ir::NodeId id, std::vector<ir::NodeId>& doubtful);

    // Whether any of the nodes depends on the variable.
    bool depend(std::span<const ir::NodeId> nodes, ir::VariableId variable) const;

    // The value of a uniform node for a tuple of axes that hold all its variables; nothing if it
    // faults.
    std::optional<ir::Value> evaluate(ir::NodeId id, std::span<const Axis> axes,
                                      std::int64_t tuple) const;

  private:
    using Found = std::optional<Relation>;

    Found of(const ir::Load& load, const ir::Value& value);
    Found of(const ir::Convert& convert, const ir::Value& value);
    Found of(const ir::Apply& apply, const ir::Value& value);
    Found of(const ir::Select& select, const ir::Value& value);
    Found of(const ir::Reduce& reduce, const ir::Value& value);
    Found of(const ir::Sample& sample, const ir::Value& value);
    Found of_doubtful_product(ir::NodeId a, ir::NodeId b, std::vector<ir::NodeId>& doubtful);
    Found of_common_elements(ir::NodeId id, const ir::Value& value);
    Found entries_of_tables(ir::NodeId id);
    Found of_zero_beside(const ir::Apply& apply, const ir::Value& value);
    Found of_equality(ir::NodeId a, ir::NodeId b);
    Found of_product(ir::NodeId a, ir::NodeId b, const ir::Value& zero);
    bool is_never_zero(ir::NodeId divisor) const;

    Found either(ir::NodeId a, ir::NodeId b, const ir::Value& value);
    Found both(ir::NodeId a, const ir::Value& value_of_a, ir::NodeId b,
               const ir::Value& value_of_b);
    Relation narrowed(Relation relation, ir::NodeId id, const ir::Value& value);
    Found by_trying_all(ir::NodeId id, const ir::Value& value);

    std::vector<Axis> axes_of(ir::NodeId id) const;
    // Whether an expression may be evaluated so often: for it, and for all of the program.
    bool affords(ir::NodeId id, double times);
    const ir::Program& program() const { return builder_.program(); }
    const ir::Properties& properties(ir::NodeId id) const { return builder_.properties(id); }

    const ir::Builder& builder_;
    const ir::Evaluator& evaluator_;
    ir::EvaluationBudget budget_;
};

}  // namespace rddlc::passes
