#include "passes/aggregations/merge_draws.hpp"

#include "ir/cost_model.hpp"
#include "ir/rewrite.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

const ir::Sample* draw(const ir::Program& program, ir::NodeId id) {
    return std::get_if<ir::Sample>(&program[id].form);
}

bool have_same_numbers(const ir::Program& program, const ir::Sample& a, const ir::Sample& b) {
    return program.series_of(a.place.site) == program.series_of(b.place.site) &&
           a.place.index == b.place.index;
}

bool may_be_wrong(const ir::Builder& builder, const ir::Sample& sample) {
    std::vector<std::optional<Range>> ranges;
    for (ir::NodeId parameter : sample.parameters)
        ranges.push_back(builder.properties(parameter).range);
    return !always_in_domain(sample.distribution, ranges);
}

// select(condition, a, b) by connectives, which cost no jump.
ir::NodeId either_of(ir::Builder& builder, ir::NodeId condition, ir::NodeId a, ir::NodeId b) {
    const ir::Program& program = builder.program();
    if (ir::constant<bool>(program, a) == true) return builder.apply(Operator::Or, {condition, b});
    if (ir::constant<bool>(program, b) == true)
        return builder.apply(Operator::Or, {builder.apply(Operator::Not, {condition}), a});
    return builder.select(condition, a, b);
}

// The probability with which a bool is true.
std::optional<double> certainty(const ir::Program& program, ir::NodeId id) {
    const auto value = ir::constant<bool>(program, id);
    if (!value) return std::nullopt;
    return *value ? 1.0 : 0.0;
}

void collect(const ir::Program& program, ir::NodeId id, std::set<ir::NodeId>& below) {
    if (!below.insert(id).second) return;
    for (ir::NodeId operand : ir::operands_of(program[id])) collect(program, operand, below);
}

// An aggregation of numbers: the chance is then an expression of it, which may become a table.
bool share_an_aggregation(const ir::Program& program, ir::NodeId a, ir::NodeId b) {
    std::set<ir::NodeId> below_a, below_b;
    collect(program, a, below_a);
    collect(program, b, below_b);
    return std::ranges::any_of(below_a, [&](ir::NodeId id) {
        return std::holds_alternative<ir::Reduce>(program[id].form) &&
               program[id].type != ir::Scalar::Bool && below_b.contains(id);
    });
}

// A draw in one branch, a constant in the other one.
std::optional<ir::NodeId> merged_with_constant(ir::Builder& builder, const ir::Select& select) {
    const ir::Program& program = builder.program();
    const ir::NodeId condition = select.condition;
    const bool is_else = draw(program, select.else_value) != nullptr;
    const ir::Sample* sample = draw(program, is_else ? select.else_value : select.then_value);
    const auto other = certainty(program, is_else ? select.then_value : select.else_value);
    if (!sample || !other || sample->distribution != Distribution::Bernoulli) return std::nullopt;
    const ir::NodeId chance = sample->parameters.front();
    if (!share_an_aggregation(program, condition, chance)) return std::nullopt;

    const ir::Place place = sample->place;
    const ir::NodeId constant = builder.constant(*other);
    const ir::NodeId chosen = is_else ? builder.select(condition, constant, chance)
                                      : builder.select(condition, chance, constant);
    return builder.sample(ir::Scalar::Bool, Distribution::Bernoulli, place, {chosen});
}

// How often the program names each node, by NodeId::index.
std::vector<int> count_uses(const ir::Program& program) {
    std::vector<int> uses(program.nodes.size());
    const std::vector<bool> reachable = ir::reachable_nodes(program);
    for (const ir::NodeId root : ir::roots_of(program)) ++uses[root.index];
    for (std::size_t index = 0; index < uses.size(); ++index) {
        if (!reachable[index]) continue;
        for (const ir::NodeId operand : ir::operands_of(program.nodes[index]))
            ++uses[operand.index];
    }
    return uses;
}

// Nothing else uses the draws of this branch: it is a draw, or a Select with a draw for a branch. A
// draw that is used elsewhere stays a draw of its own, and then the merged one would draw from its
// site once more.
bool draws_only_here(const ir::Program& program, ir::NodeId branch, const std::vector<int>& uses) {
    const bool is_only_here = uses[branch.index] == 1;
    const auto* select = std::get_if<ir::Select>(&program[branch].form);
    if (!select) return !draw(program, branch) || is_only_here;
    return is_only_here && draws_only_here(program, select->then_value, uses) &&
           draws_only_here(program, select->else_value, uses);
}

// Selects whose branches may become one, by NodeId::index.
std::vector<bool> candidates(const ir::Program& program) {
    const std::vector<int> uses = count_uses(program);
    std::vector<bool> found;
    for (const ir::Node& node : program.nodes) {
        const auto* select = std::get_if<ir::Select>(&node.form);
        found.push_back(select && draws_only_here(program, select->then_value, uses) &&
                        draws_only_here(program, select->else_value, uses));
    }
    return found;
}

// A value that is drawn where a condition holds, and otherwise something else.
struct Drawn {
    ir::Sample sample;
    std::optional<ir::NodeId> condition;  // absent: it is always drawn
    std::optional<ir::NodeId> otherwise;
};

// A merged draw evaluates its conditions once more, for its parameters. Each draw that is saved
// pays for that many operations; the number is not measured.
constexpr double most_repeated = 4 * ir::draw_cost;
bool may_be_repeated(const ir::Properties& condition) {
    return condition.cost < most_repeated && ir::is_droppable(condition);
}

// One of the branches may be such a value.
std::optional<Drawn> drawn(ir::Builder& builder, ir::NodeId id) {
    const ir::Program& program = builder.program();
    if (const ir::Sample* sample = draw(program, id)) return Drawn{*sample, {}, {}};
    const auto* found = std::get_if<ir::Select>(&program[id].form);
    if (!found || !may_be_repeated(builder.properties(found->condition))) return std::nullopt;
    const ir::Select select = *found;  // building nodes moves the pool
    const auto a = drawn(builder, select.then_value);
    const auto b = drawn(builder, select.else_value);
    if (a.has_value() == b.has_value()) return std::nullopt;
    const Drawn& inner = a ? *a : *b;
    const ir::NodeId here = a ? select.condition : builder.apply(Operator::Not, {select.condition});
    Drawn result{inner.sample, here, a ? select.else_value : select.then_value};
    if (inner.condition) result.condition = builder.apply(Operator::And, {here, *inner.condition});
    if (inner.otherwise)
        result.otherwise =
            a ? builder.select(select.condition, *inner.otherwise, select.else_value)
              : builder.select(select.condition, select.then_value, *inner.otherwise);
    return result;
}

std::optional<ir::NodeId> merged(ir::Builder& builder, const ir::Select& select) {
    const ir::Program& program = builder.program();
    const auto a = drawn(builder, select.then_value);
    if (!a) return std::nullopt;
    const auto b = drawn(builder, select.else_value);
    if (!b || a->sample.distribution != b->sample.distribution ||
        !have_same_numbers(program, a->sample, b->sample))
        return std::nullopt;
    const bool then_faults = may_be_wrong(builder, a->sample);
    const bool else_faults = may_be_wrong(builder, b->sample);
    if (then_faults && else_faults) return std::nullopt;
    const bool is_repeated = a->condition || b->condition;
    if (is_repeated && !may_be_repeated(builder.properties(select.condition))) return std::nullopt;

    const auto chosen = [&](ir::NodeId then_value, ir::NodeId else_value) {
        return builder.select(select.condition, then_value, else_value);
    };
    std::vector<ir::NodeId> parameters;
    for (std::size_t k = 0; k < a->sample.parameters.size(); ++k)
        parameters.push_back(chosen(a->sample.parameters[k], b->sample.parameters[k]));
    const ir::NodeId draw_of_both =
        builder.sample(program[select.then_value].type, a->sample.distribution,
                       else_faults ? b->sample.place : a->sample.place, std::move(parameters));
    if (!is_repeated) return draw_of_both;

    const ir::NodeId always = builder.constant(true);
    const ir::NodeId is_drawn = either_of(builder, select.condition, a->condition.value_or(always),
                                          b->condition.value_or(always));
    const ir::NodeId otherwise = !a->otherwise   ? *b->otherwise
                                 : !b->otherwise ? *a->otherwise
                                                 : chosen(*a->otherwise, *b->otherwise);
    return builder.select(is_drawn, draw_of_both, otherwise);
}

// A draw with a probability of 0 or 1.
std::optional<ir::NodeId> decided(ir::Builder& builder, const ir::Sample& sample) {
    if (sample.distribution != Distribution::Bernoulli) return std::nullopt;
    const auto p = ir::constant<double>(builder.program(), sample.parameters.front());
    if (!p || (*p != 0.0 && *p != 1.0)) return std::nullopt;
    return builder.constant(*p == 1.0);
}

}  // namespace

ir::Program merge_draws(ir::Program program, Report& report) {
    const std::vector<bool> is_candidate = candidates(program);
    return ir::rewrite(std::move(program),
                       [&](ir::Builder& builder, ir::NodeId id,
                           const ir::Node& node) -> std::optional<ir::NodeId> {
                           if (const auto* sample = std::get_if<ir::Sample>(&node.form)) {
                               const auto value = decided(builder, *sample);
                               if (value) ++report["draws decided"];
                               return value;
                           }
                           if (!is_candidate[id.index]) return std::nullopt;
                           const auto* select = std::get_if<ir::Select>(&node.form);
                           if (const auto draw = merged(builder, *select)) {
                               ++report["pairs of draws made one"];
                               return draw;
                           }
                           const auto draw = merged_with_constant(builder, *select);
                           if (draw) ++report["draws made to include constants"];
                           return draw;
                       });
}

}  // namespace rddlc::passes
