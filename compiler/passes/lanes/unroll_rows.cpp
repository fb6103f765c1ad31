#include "passes/lanes/unroll_rows.hpp"

#include "ir/nest.hpp"
#include "ir/rewrite.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// More operations (Properties::cost) of all iterations are too much text.
constexpr double most_operations = 1000;
// And in operations beside the sums of an iteration: more of them are worth a loop, which may run
// over several objects at once.
constexpr double most_beside_sums = 5;

class Unrolling {
  public:
    Unrolling(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        for (ir::Definition& definition : program_.step) unroll_in(definition.body);
        unroll_in(program_.reward.body);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    using Known = std::map<ir::NodeId, ir::NodeId>;

    void unroll_in(ir::Block& block) {
        ir::Block result;
        for (ir::Statement& statement : block) {
            const auto* loop = std::get_if<ir::Loop>(&statement.form);
            const ir::Store* store = loop ? sums_over_rows(*loop) : nullptr;
            if (store) {
                ++report_["loops over rows unrolled"];
                unroll(*store, ir::nest_of(*loop).variables, {}, result);
            } else {
                result.push_back(std::move(statement));
            }
        }
        block = std::move(result);
    }

    // The only statement of small loops.
    const ir::Store* sums_over_rows(const ir::Loop& loop) const {
        const ir::Nest nest = ir::nest_of(loop);
        const auto* store = ir::only_statement<ir::Store>(*nest.body);
        if (!store) return nullptr;
        double cost = builder_.properties(store->value).cost;
        for (ir::VariableId variable : nest.variables)
            cost *= static_cast<double>(program_[variable].size);
        const double sums = cost_of_sums(store->value);
        const bool is_worth_it = sums > 0 && cost <= most_operations &&
                                 builder_.properties(store->value).cost - sums <= most_beside_sums;
        // Last, as it walks through the whole expression, which is small then.
        return is_worth_it && !has_place(store->value) ? store : nullptr;
    }

    // It draws or may fault at a site, which belongs to one node.
    bool has_place(ir::NodeId id) const {
        return ir::any_node_of(program_, id, [&](ir::NodeId each) {
            return ir::place_of(program_[each]).has_value();
        });
    }

    // The cost of the sums over rows that are evaluated in any case.
    double cost_of_sums(ir::NodeId id) const {
        const ir::Node& node = program_[id];
        if (is_sum_over_row(node)) return builder_.properties(id).cost;
        if (ir::bound_variable(node) || std::holds_alternative<ir::Select>(node.form)) return 0;
        double cost = 0;
        for (ir::NodeId operand : ir::operands_of(node)) cost += cost_of_sums(operand);
        return cost;
    }
    bool is_sum_over_row(const ir::Node& node) const {
        const auto* sum = std::get_if<ir::Reduce>(&node.form);
        return sum && sum->op == Reduction::Sum && sum->bounds &&
               ir::row_of(program_, *sum->bounds);
    }

    // Unrolls all values of these variables, given those of the outer ones.
    void unroll(const ir::Store& store, std::span<const ir::VariableId> variables,
                const Known& outer, ir::Block& result) {
        if (variables.empty()) return result.push_back({unrolled(store, outer)});
        const ir::NodeId variable = builder_.index(variables.front());
        for (std::int64_t k = 0; k < program_[variables.front()].size; ++k) {
            Known known = outer;
            known[variable] = builder_.constant(k);
            unroll(store, variables.subspan(1), known, result);
        }
    }
    ir::Store unrolled(const ir::Store& store, const Known& variables) {
        ir::Store result = store;
        for (ir::NodeId& index : result.indices) index = with(index, variables);
        Known sums;
        result.value = ir::replace_in(builder_, with(store.value, variables), sums,
                                      [&](ir::NodeId id) { return sum_of_terms(program_[id]); });
        return result;
    }
    ir::NodeId with(ir::NodeId id, Known known) { return ir::replace_in(builder_, id, known); }

    std::optional<ir::NodeId> sum_of_terms(const ir::Node& node) {
        const auto* form = std::get_if<ir::Reduce>(&node.form);
        if (!form || form->op != Reduction::Sum || !form->bounds) return std::nullopt;
        const ir::Reduce sum = *form;  // the builder moves nodes
        const auto begin = ir::constant<std::int64_t>(program_, sum.bounds->begin);
        const auto end = ir::constant<std::int64_t>(program_, sum.bounds->end);
        if (!begin || !end) return std::nullopt;
        const ir::NodeId variable = builder_.index(sum.variable);
        std::optional<ir::NodeId> total;
        for (std::int64_t entry = *begin; entry < *end; ++entry) {
            const ir::NodeId term = with(sum.body, {{variable, builder_.constant(entry)}});
            total = total ? builder_.apply(Operator::Add, {*total, term}) : term;
        }
        if (total) total = builder_.aggregated(Reduction::Sum, *total);
        return total;
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
};

}  // namespace

ir::Program unroll_rows(ir::Program program, Report& report) {
    return Unrolling(std::move(program), report).run();
}

}  // namespace rddlc::passes
