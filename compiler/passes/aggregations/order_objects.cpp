#include "passes/aggregations/order_objects.hpp"

#include "ir/analysis.hpp"
#include "ir/reduction_nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/equivalence.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

class Ordering {
  public:
    Ordering(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        ir::change_roots(program_, [&](ir::NodeId& root) { root = rewritten(root); });
        return ir::collect_garbage(std::move(program_));
    }

  private:
    // For each variable of a nest, the one behind whose object it begins.
    using Predecessors = std::vector<std::optional<std::size_t>>;

    ir::NodeId rewritten(ir::NodeId id) {
        return ir::replace_in(builder_, id, known_, [&](ir::NodeId each) { return ordered(each); });
    }

    std::optional<ir::NodeId> ordered(ir::NodeId id) {
        const auto nest = ir::reduction_nest(program_, id);
        if (!nest || !is_quantifier(nest->op) || !ir::is_droppable(builder_.properties(nest->body)))
            return std::nullopt;
        Predecessors before(nest->variables.size());
        for (std::size_t j = 1; j < before.size(); ++j) before[j] = last_exchanged(*nest, j);
        if (std::ranges::none_of(before, [](const auto& i) { return i.has_value(); }))
            return std::nullopt;
        ++report_["quantifiers over ordered objects"];
        return in_order(*nest, before);
    }

    ir::NodeId in_order(const ir::ReductionNest& nest, const Predecessors& before) {
        const std::vector<ir::VariableId>& variables = nest.variables;
        ir::NodeId body = nest.body;
        for (std::size_t j = 0; j < variables.size(); ++j)
            for (auto i = before[j]; i; i = before[*i])
                body = where_different(body, variables[*i], variables[j]);
        body = rewritten(body);
        for (std::size_t j = variables.size(); j-- > 0;)
            body = builder_.reduce(
                nest.op, variables[j], body,
                before[j] ? std::optional(behind(variables[*before[j]])) : std::nullopt);
        return body;
    }

    // The last one of the variables before variable j that may change places with it.
    std::optional<std::size_t> last_exchanged(const ir::ReductionNest& nest, std::size_t j) {
        for (std::size_t i = j; i-- > 0;)
            if (may_change_places(nest.body, nest.variables[i], nest.variables[j]) &&
                is_neutral_where_equal(nest, nest.variables[i], nest.variables[j]))
                return i;
        return std::nullopt;
    }

    bool may_change_places(ir::NodeId body, ir::VariableId a, ir::VariableId b) {
        const ir::Properties& properties = builder_.properties(body);
        if (program_[a].size != program_[b].size || !ir::depends_on_any(properties, {&a, 1}) ||
            !ir::depends_on_any(properties, {&b, 1}))
            return false;
        const ir::NodeId first = builder_.index(a), second = builder_.index(b);
        std::map<ir::NodeId, ir::NodeId> exchange = {{first, second}, {second, first}};
        return are_equivalent(program_, body, ir::replace_in(builder_, body, exchange));
    }

    bool is_neutral_where_equal(const ir::ReductionNest& nest, ir::VariableId a, ir::VariableId b) {
        std::map<ir::NodeId, ir::NodeId> equal = {{builder_.index(b), builder_.index(a)}};
        const ir::NodeId term = ir::replace_in(builder_, nest.body, equal);
        return ir::constant<bool>(program_, term) == (nest.op == Reduction::ForAll);
    }

    ir::NodeId where_different(ir::NodeId body, ir::VariableId a, ir::VariableId b) {
        const ir::NodeId first = builder_.index(a), second = builder_.index(b);
        std::map<ir::NodeId, ir::NodeId> known;
        for (const auto& operands : {std::vector{first, second}, std::vector{second, first}}) {
            known[builder_.apply(Operator::Equal, operands)] = builder_.constant(false);
            known[builder_.apply(Operator::NotEqual, operands)] = builder_.constant(true);
        }
        return ir::replace_in(builder_, body, known);
    }

    ir::Bounds behind(ir::VariableId variable) {
        const ir::NodeId one = builder_.constant(std::int64_t{1});
        return {builder_.apply(Operator::Add, {builder_.index(variable), one}),
                builder_.constant(program_[variable].size)};
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    std::map<ir::NodeId, ir::NodeId> known_;
};

}  // namespace

ir::Program order_objects(ir::Program program, Report& report) {
    return Ordering(std::move(program), report).run();
}

}  // namespace rddlc::passes
