#include "passes/aggregations/take_only_objects.hpp"

#include "ir/fold.hpp"
#include "ir/reduction_nest.hpp"
#include "ir/rewrite.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

namespace rddlc::passes {
namespace {

class Indexing {
  public:
    Indexing(ir::Program program, const FindOnlyObject& find)
        : program_(std::move(program)), find_(find), builder_(program_) {}

    ir::Program run() && {
        ir::change_roots(program_, [&](ir::NodeId& root) { root = rewritten(root); });
        return ir::collect_garbage(std::move(program_));
    }

  private:
    ir::NodeId rewritten(ir::NodeId id) {
        if (const auto known = done_.find(id); known != done_.end()) return known->second;
        ir::Node node = program_[id];
        ir::change_operands(node, [&](ir::NodeId& operand) { operand = rewritten(operand); });
        ir::NodeId result = builder_.rebuild(node);
        // The result may be an aggregation to which this applies again.
        if (const auto indexed = indexed_directly(result)) result = rewritten(*indexed);
        return done_[id] = result;
    }

    std::optional<ir::NodeId> indexed_directly(ir::NodeId id) {
        const auto* reduce = std::get_if<ir::Reduce>(&program_[id].form);
        if (!reduce || reduce->bounds) return std::nullopt;
        const auto neutral = ir::fold_empty(reduce->op, program_[reduce->body].type);
        if (!neutral) return std::nullopt;
        const ir::VariableId variable = reduce->variable;
        const ir::ReductionNest nest = *ir::reduction_nest(program_, id);
        if (has_place_of(variable, nest.body)) return std::nullopt;
        for (const Condition& condition : decisive_conditions(builder_, nest.body, *neutral)) {
            const auto object = find_(program_, builder_, condition, variable);
            if (!object || adds_in_another_order(nest, object->index)) continue;
            return taken(nest, variable, condition, *object, *neutral);
        }
        return std::nullopt;
    }

    // ------------------------------------------------------------------------- the nest

    // The inner variables are those without the variable of the object that is taken.
    static std::span<const ir::VariableId> inner(const ir::ReductionNest& nest) {
        return std::span(nest.variables).subspan(1);
    }

    // An object for each of the inner ones gives one sum in place of a sum for each object; in
    // which order reals are added matters.
    bool adds_in_another_order(const ir::ReductionNest& nest, ir::NodeId object) const {
        return program_[nest.body].type == ir::Scalar::Real && depends_on_any(object, inner(nest));
    }

    ir::NodeId over_inner(const ir::ReductionNest& nest, ir::NodeId body) {
        return ir::reduced(builder_, nest.op, inner(nest), body);
    }

    // The value of the nest, given the object.
    ir::NodeId taken(const ir::ReductionNest& nest, ir::VariableId variable,
                     const Condition& condition, const OnlyObject& object,
                     const ir::Value& neutral) {
        // A body that may fault is evaluated in any case, so the condition is tested in its place.
        const bool in_place = builder_.properties(nest.body).may_fault;
        const ir::NodeId exists = in_place ? object.exists : builder_.constant(true);
        std::map<ir::NodeId, ir::NodeId> known;
        known[condition.id] = condition.needed ? exists : builder_.apply(Operator::Not, {exists});
        known[builder_.index(variable)] = object.index;
        const ir::NodeId body = ir::replace_in(builder_, nest.body, known);
        const auto value = [&] {
            if (in_place) return over_inner(nest, body);
            if (depends_on_any(object.exists, inner(nest)))
                return over_inner(nest, guarded(object.exists, body, neutral));
            return guarded(object.exists, over_inner(nest, body), neutral);
        };
        return builder_.aggregated(nest.op, value());
    }

    ir::NodeId guarded(ir::NodeId exists, ir::NodeId value, const ir::Value& neutral) {
        const bool* is_true = std::get_if<bool>(&neutral);
        if (!is_true) return builder_.select(exists, value, builder_.constant(neutral));
        if (!*is_true) return builder_.apply(Operator::And, {exists, value});
        return builder_.apply(Operator::Or, {builder_.apply(Operator::Not, {exists}), value});
    }

    // -------------------------------------------------------------------- what may happen

    // Has a draw or a possible fault below the node a place that depends on the variable?
    bool has_place_of(ir::VariableId variable, ir::NodeId id) const {
        if (!depends_on(id, variable)) return false;
        const auto place = ir::place_of(program_[id]);
        if (place && depends_on(place->index, variable)) return true;
        return std::ranges::any_of(ir::operands_of(program_[id]), [&](ir::NodeId operand) {
            return has_place_of(variable, operand);
        });
    }

    bool depends_on_any(ir::NodeId id, std::span<const ir::VariableId> variables) const {
        return ir::depends_on_any(builder_.properties(id), variables);
    }

    bool depends_on(ir::NodeId id, ir::VariableId variable) const {
        return ir::depends_on(builder_.properties(id), variable);
    }

    ir::Program program_;
    const FindOnlyObject& find_;
    ir::Builder builder_;
    std::map<ir::NodeId, ir::NodeId> done_;
};

}  // namespace

ir::Program take_only_objects(ir::Program program, const FindOnlyObject& find) {
    return Indexing(std::move(program), find).run();
}

}  // namespace rddlc::passes
