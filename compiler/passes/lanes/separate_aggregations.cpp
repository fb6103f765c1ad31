#include "passes/lanes/separate_aggregations.hpp"

#include "ir/cost_model.hpp"
#include "ir/fill_table.hpp"
#include "ir/nest.hpp"
#include "ir/reduction_nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/few_true.hpp"
#include "passes/analyses/object_lanes.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// Operations (Properties::cost) that are worth writing a value to a table and reading it again.
constexpr double worth_separating = 10;
// An action that chooses one of so many objects at most makes a branch rare.
constexpr std::int64_t least_per_rare = 2;

using Variables = std::vector<ir::VariableId>;

class Separation {
  public:
    Separation(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        for (ir::Definition& definition : program_.step) {
            name_ = program_[definition.target].name;
            span_ = definition.span;
            definition.body = separated(std::move(definition.body));
        }
        name_ = "reward";
        span_ = program_.reward.span;
        program_.reward.value = with_terms(program_.reward.value, program_.reward.body);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    ir::Block separated(ir::Block block) {
        ir::Block result;
        for (ir::Statement& statement : block) {
            if (auto* loop = std::get_if<ir::Loop>(&statement.form)) separate(*loop, result);
            if (auto* store = std::get_if<ir::Store>(&statement.form))
                store->value = with_terms(store->value, result);
            result.push_back(std::move(statement));
        }
        return result;
    }

    // ------------------------------------------------------------- aggregations inside of loops

    void separate(ir::Loop& loop, ir::Block& before) {
        const ir::Nest nest = ir::nest_of(loop);
        auto* const store = ir::only_statement<ir::Store>(ir::innermost_body(loop));
        if (!store) return;
        std::vector<ir::NodeId> aggregations;
        const bool all_found = find_aggregations(store->value, nest.variables, aggregations);
        if (!all_found || aggregations.empty() || ir::reads(program_, store->value, store->target))
            return;
        const auto is_one = [&](ir::NodeId id) {
            return std::ranges::find(aggregations, id) != aggregations.end();
        };
        const ObjectLanes several = several_of(nest, is_one);
        const auto is_computed_before = [&](ir::NodeId id) {
            return is_one(id) || !ir::depends_on_any(builder_.properties(id), nest.variables);
        };
        if (cost_of_rest(store->value, is_computed_before) < worth_separating ||
            !several.are_enough(program_[store->target].scalar) || !several.can_store(*store) ||
            several_of(nest, nullptr).can_store(*store))
            return;

        std::map<ir::NodeId, ir::NodeId> elements;
        for (const ir::NodeId id : aggregations)
            elements[id] = table_of(id, "part", nest.variables, before);
        store->value = ir::replace_in(builder_, store->value, elements);
        loop.several_at_once = true;
        report_["loops whose aggregations are computed before"] += 1;
    }

    // The cost of a value without these parts of it.
    template <class IsLeftOut>
    double cost_of_rest(ir::NodeId id, const IsLeftOut& is_left_out) const {
        if (is_left_out(id)) return 0;
        double cost = builder_.properties(id).cost;
        for (const ir::NodeId operand : ir::operands_of(program_[id]))
            cost += cost_of_rest(operand, is_left_out) - builder_.properties(operand).cost;
        return cost;
    }

    // The outermost ones; false if there is one that must stay where it is.
    bool find_aggregations(ir::NodeId id, const Variables& variables,
                           std::vector<ir::NodeId>& found) const {
        const ir::Node& node = program_[id];
        if (std::holds_alternative<ir::Reduce>(node.form)) {
            const ir::Properties& properties = builder_.properties(id);
            if (properties.may_fault || properties.random || node.type == ir::Scalar::Int ||
                !is_over(properties, variables))
                return false;
            if (std::ranges::find(found, id) == found.end()) found.push_back(id);
            return true;
        }
        if (const auto* select = std::get_if<ir::Select>(&node.form))
            return find_aggregations(select->condition, variables, found) &&
                   find_in_branch(select->then_value, may_fill_then(*select), variables, found) &&
                   find_in_branch(select->else_value, may_fill_else(*select), variables, found);
        return std::ranges::all_of(ir::operands_of(node), [&](ir::NodeId operand) {
            return find_aggregations(operand, variables, found);
        });
    }
    // A condition that holds only where the action chooses the object.
    bool is_rare(ir::NodeId condition) const {
        const ir::Node& node = program_[condition];
        const auto is_rare_too = [&](ir::NodeId operand) {
            return is_rare(operand);
        };
        if (const auto* load = std::get_if<ir::Load>(&node.form))
            return acts_with_few_true(program_[load->buffer], least_per_rare);
        const auto* apply = std::get_if<ir::Apply>(&node.form);
        if (!apply) return false;
        if (apply->op == Operator::And) return std::ranges::any_of(apply->operands, is_rare_too);
        return apply->op == Operator::Or && std::ranges::all_of(apply->operands, is_rare_too);
    }
    // Where chance decides whether a branch is taken, or goes on in it, jumps are mispredicted.
    bool may_fill_then(const ir::Select& select) const {
        return is_by_chance(select, select.then_value) && !is_rare(select.condition);
    }
    bool may_fill_else(const ir::Select& select) const {
        return is_by_chance(select, select.else_value);
    }
    bool is_by_chance(const ir::Select& select, ir::NodeId branch) const {
        return builder_.properties(select.condition).random || builder_.properties(branch).random;
    }
    // All objects compute those, also the objects that do not take the branch.
    bool find_in_branch(ir::NodeId id, bool may_be_computed, const Variables& variables,
                        std::vector<ir::NodeId>& found) const {
        std::vector<ir::NodeId> inside;
        const auto is_cheap = [&](ir::NodeId each) {
            return may_be_computed && builder_.properties(each).cost <= ir::mispredicted_jump_cost;
        };
        if (!find_aggregations(id, variables, inside) || !std::ranges::all_of(inside, is_cheap))
            return false;
        std::ranges::copy_if(inside, std::back_inserter(found), [&](ir::NodeId each) {
            return std::ranges::find(found, each) == found.end();
        });
        return true;
    }

    // A table of these variables can hold it: nothing else around it, such as the draw of an object
    // (DiscreteOver), binds what it depends on.
    static bool is_over(const ir::Properties& properties, const Variables& variables) {
        return ir::depends_on_none_but(properties, variables);
    }

    // ---------------------------------------------------------------------------- terms of sums

    // A value outside of loops, the terms of whose sums are tables.
    ir::NodeId with_terms(ir::NodeId value, ir::Block& before) {
        return ir::replace_reductions_in(builder_, value,
                                         [&](ir::NodeId id) { return over_table(id, before); });
    }

    std::optional<ir::NodeId> over_table(ir::NodeId id, ir::Block& before) {
        const auto nest = ir::reduction_nest(program_, id);
        const bool is_quantifier = nest && program_[nest->body].type == ir::Scalar::Bool;
        if (!nest || (nest->op != Reduction::Sum && !is_quantifier) ||
            !is_worth_a_table(nest->variables, nest->body))
            return std::nullopt;
        report_[is_quantifier ? "quantifiers whose terms are computed before"
                              : "sums whose terms are computed before"] += 1;
        const ir::NodeId term = table_of(nest->body, "terms", nest->variables, before);
        std::get<ir::Loop>(before.back().form).several_at_once = true;
        return ir::reduced(builder_, nest->op, nest->variables, term);
    }

    bool is_worth_a_table(const Variables& variables, ir::NodeId term) const {
        const ir::Properties& properties = builder_.properties(term);
        if (program_[term].type == ir::Scalar::Int || properties.may_fault || properties.random ||
            properties.cost < worth_separating || !is_over(properties, variables))
            return false;
        const ObjectLanes several = several_of({variables, nullptr}, nullptr);
        return several.are_enough(program_[term].type) && several.can_evaluate(term);
    }

    // ------------------------------------------------------------------------------------ tables

    // An element of a new table with the values of a node, which `before` fills.
    ir::NodeId table_of(ir::NodeId id, const std::string& what, const Variables& variables,
                        ir::Block& before) {
        const ir::BufferId table = builder_.tables().scratch(
            name_ + "-" + what, program_[id].type, builder_.properties(id).range, variables, span_);
        return ir::fill_table(builder_, before, table, variables, id);
    }

    ObjectLanes several_of(const ir::Nest& nest, std::function<bool(ir::NodeId)> is_element) const {
        return {builder_, nest, std::move(is_element)};
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    std::string name_;  // of what is computed
    Span span_;
};

}  // namespace

ir::Program separate_aggregations(ir::Program program, Report& report) {
    return Separation(std::move(program), report).run();
}

}  // namespace rddlc::passes
