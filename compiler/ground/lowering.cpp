// Over 400 lines: a function for each kind of expression.
#include "ground/lowering.hpp"

#include "ground/codes.hpp"
#include "ir/cost_model.hpp"
#include "support/match.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace rddlc::grounding {
namespace {

// The limit in operations (ir::Properties). Passes name values that are used several times; this is
// for nested products, which would grow exponentially until then.
constexpr double largest_repeated_cost = 10 * ir::elementary_cost;
// Selects inside each other that a 'switch' becomes.
constexpr std::size_t longest_chain = 512;

// Whether pyRDDLGym evaluates it first when it is the right operand of * ^ |.
bool is_simple(const model::Expr& expr) {
    if (const auto* convert = std::get_if<model::Convert>(&expr.node)) {
        return is_simple(*convert->operand);
    }
    return std::holds_alternative<model::Constant>(expr.node) ||
           std::holds_alternative<model::Reference>(expr.node);
}

bool needs_an_object(Reduction op) {
    return op == Reduction::Minimum || op == Reduction::Maximum || op == Reduction::ArgMin ||
           op == Reduction::ArgMax;
}

}  // namespace

Lowering::Lowering(const model::Model& model, const std::vector<FluentBuffers>& buffers,
                   ir::Program& program, ir::Builder& builder, Diagnostics& diagnostics)
    : model_(model),
      buffers_(buffers),
      program_(program),
      builder_(builder),
      diagnostics_(diagnostics) {}

// --------------------------------------------------------------------- definitions and values

// Loops over the parameters around one store, behind what it needs first.
ir::Definition Lowering::definition_of(const model::Cpf& cpf) {
    enter(cpf.parameters);
    const FluentBuffers& buffers = buffers_[cpf.fluent];
    ir::Store store{.target = buffers.next.value_or(buffers.current), .indices = {}, .value = {}};
    for (ir::VariableId parameter : scope_) store.indices.push_back(builder_.index(parameter));
    store.value = lower_as(cpf.body, scalar_of(model_.fluents[cpf.fluent].range));
    ir::Buffer& target = program_.buffers[store.target.index];
    if (target.is_computed_in_step()) target.range = range_of_reals(store.value);

    ir::Block body = std::exchange(prelude_, {});
    body.push_back(looped({store}, scope_));
    leave(cpf.parameters.size());
    return {store.target, std::move(body), cpf.span};
}

// One store, behind what it needs first.
ir::Definition Lowering::definition_of(const model::InitialDraw& draw) {
    ir::Store store{.target = buffers_[draw.fluent].current, .indices = {}, .value = {}};
    for (std::int64_t object : draw.objects) store.indices.push_back(integer(object));
    store.value = lower_as(draw.value, scalar_of(model_.fluents[draw.fluent].range));
    ir::Block body = std::exchange(prelude_, {});
    body.push_back({store});
    return {store.target, std::move(body), draw.span};
}

ir::Computation Lowering::value_of(const model::Expr& expr) {
    const ir::NodeId value = lower(expr);
    return {std::exchange(prelude_, {}), value, expr.span};
}

// The statement inside loops, outermost first. A variable over a single object needs no loop: its
// index is 0.
ir::Statement Lowering::looped(ir::Statement statement,
                               std::span<const ir::VariableId> variables) const {
    for (auto variable = variables.rbegin(); variable != variables.rend(); ++variable) {
        if (program_[*variable].size == 1) continue;
        ir::Loop loop{*variable, {}};
        loop.body.push_back(std::move(statement));
        statement = {std::move(loop)};
    }
    return statement;
}

// --------------------------------------------------------------------------- scope and places

void Lowering::enter(std::span<const model::VariableId> variables) {
    for (model::VariableId variable : variables) scope_.push_back(variable_of(variable));
}

void Lowering::leave(std::size_t count) {
    scope_.resize(scope_.size() - count);
}

ir::VariableId Lowering::variable_of(model::VariableId id) {
    const model::Variable& variable = model_.variables[id];
    const ir::VariableId next{static_cast<std::uint32_t>(program_.variables.size())};
    const auto [entry, is_new] = variables_.try_emplace({variable.name, variable.type}, next);
    if (is_new) program_.variables.push_back({variable.name, variable.type, size_of(id)});
    return entry->second;
}

std::int64_t Lowering::size_of(model::VariableId id) const {
    return static_cast<std::int64_t>(model_.type_of(model_.variables[id]).objects.size());
}

ir::NodeId Lowering::row_major_index(std::span<const ir::VariableId> variables) {
    ir::NodeId index = integer(0);
    for (ir::VariableId variable : variables) {
        const ir::NodeId size = integer(program_[variable].size);
        const ir::NodeId row = builder_.apply(Operator::Multiply, {index, size});
        index = builder_.apply(Operator::Add, {row, builder_.index(variable)});
    }
    return index;
}

ir::Place Lowering::new_place(const model::Expr& expr, std::string what) {
    return new_place(expr, std::move(what), scope_);
}

ir::Place Lowering::new_place(const model::Expr& expr, std::string what,
                              const std::vector<ir::VariableId>& scope) {
    constexpr double largest = std::numeric_limits<std::uint32_t>::max();
    double count = 1;
    for (ir::VariableId variable : scope) count *= static_cast<double>(program_[variable].size);
    if (count > largest) {
        diagnostics_.report(
            {too_many_groundings, expr.span,
             fmt::format("'{}' has {:.0f} groundings, more than {:.0f}", what, count, largest)});
    }
    program_.sites.push_back({expr.span, scope, std::move(what)});
    const auto site = static_cast<std::uint32_t>(program_.sites.size() - 1);
    return {ir::SiteId{site}, row_major_index(scope)};
}

// A draw that shares its numbers with a draw of other branches, if one is left.
ir::Place Lowering::new_draw(const model::Expr& expr, std::string what) {
    const ir::Place place = new_place(expr, std::move(what));
    const auto shared = std::ranges::find_if(
        series_, [&](ir::SiteId site) { return program_[site].scope == scope_; });
    if (shared == series_.end()) {
        drawing_.push_back(place.site);
        return place;
    }
    program_.sites.back().series = *shared;
    series_.erase(shared);
    return place;
}

// -------------------------------------------------------------------------------- expressions

ir::NodeId Lowering::lower(const model::Expr& expr) {
    return match(expr.node, [&](const auto& form) { return lower(form, expr); });
}

ir::NodeId Lowering::lower_as(const model::Expr& expr, ir::Scalar type) {
    return builder_.convert(lower(expr), type);
}

std::optional<Range> Lowering::range_of_reals(ir::NodeId value) const {
    if (program_[value].type != ir::Scalar::Real) return std::nullopt;
    return builder_.properties(value).range;
}

ir::NodeId Lowering::lower_lazily(const model::Expr& expr) {
    ++branches_;
    const ir::NodeId node = lower(expr);
    --branches_;
    return node;
}

// Draws of different branches have the same numbers: there is never more than one of them.
std::vector<ir::NodeId> Lowering::lower_branches(const std::vector<const model::Expr*>& branches) {
    std::vector<ir::SiteId> unused = series_, series = series_;
    std::vector<ir::NodeId> values;
    for (const model::Expr* branch : branches) {
        const auto own = static_cast<std::ptrdiff_t>(drawing_.size());
        series_ = series;
        values.push_back(lower_lazily(*branch));
        const auto is_used = [&](ir::SiteId site) {
            return std::ranges::find(series_, site) == series_.end();
        };
        std::erase_if(unused, is_used);
        series.insert(series.end(), drawing_.begin() + own, drawing_.end());
    }
    series_ = std::move(unused);
    return values;
}

std::vector<ir::NodeId> Lowering::lower_all(const std::vector<model::Expr>& exprs) {
    std::vector<ir::NodeId> nodes;
    for (const model::Expr& expr : exprs) nodes.push_back(lower(expr));
    return nodes;
}

ir::NodeId Lowering::lower(const model::Constant& form, const model::Expr&) {
    return builder_.constant(form.value);
}

ir::NodeId Lowering::lower(const model::VariableValue& form, const model::Expr&) {
    return builder_.index(variable_of(form.variable));
}

ir::NodeId Lowering::lower(const model::Reference& form, const model::Expr&) {
    const FluentBuffers& buffers = buffers_[form.fluent];
    return builder_.load(form.next ? *buffers.next : buffers.current, lower_all(form.arguments));
}

ir::NodeId Lowering::lower(const model::Convert& form, const model::Expr& expr) {
    return lower_as(*form.operand, scalar_of(expr.type));
}

ir::NodeId Lowering::lower(const model::TypeFault& form, const model::Expr& expr) {
    return builder_.fault(scalar_of(expr.type), new_place(expr, form.message));
}

ir::NodeId Lowering::lower(const model::Apply& form, const model::Expr& expr) {
    if (form.op == Operator::Multiply) return product(form);
    if (is_one_of(form.op, {Operator::And, Operator::Or, Operator::Implies}))
        return connective(form);
    if (form.op == Operator::Equivalent)
        return builder_.apply(Operator::Equal, lower_all(form.operands));
    std::vector<ir::NodeId> operands = lower_all(form.operands);
    const bool on_integers = program_[operands.front()].type == ir::Scalar::Int;
    std::optional<ir::Place> place;
    if (may_fault(form.op, on_integers)) {
        place = new_place(expr, std::string(source_name_of(form.op)));
    }
    return builder_.apply(form.op, std::move(operands), place);
}

// A simple right operand decides whether a fallible left one is evaluated, else the left operand
// about the right one.
// Semantics 6.3.
ir::NodeId Lowering::connective(const model::Apply& form) {
    const bool symmetric = form.op != Operator::Implies;
    const bool right_first = symmetric && is_simple(form.operands.back());
    const ir::NodeId left =
        right_first ? lower_lazily(form.operands.front()) : lower(form.operands.front());
    const ir::NodeId right =
        right_first ? lower(form.operands.back()) : lower_lazily(form.operands.back());
    if (right_first && builder_.properties(left).may_fault) {
        return builder_.apply(form.op, {right, left});
    }
    return builder_.apply(form.op, {left, right});
}

// Does multiplying by it leave 0 and -0 as they are, without a fault?
bool Lowering::keeps_zeros(ir::NodeId factor) const {
    const ir::Properties& properties = builder_.properties(factor);
    if (properties.may_fault) return false;
    if (program_[factor].type == ir::Scalar::Int) return true;
    return properties.finite && properties.never_negative_zero && properties.range &&
           properties.range->lower >= 0;
}

// Semantics 6.2: 0 * x is 0 whatever x is, and x is not evaluated, if the first factor is the same
// for all objects in scope. Where it is not, that depends on the other objects in pyRDDLGym; there
// it is an ordinary product here.
ir::NodeId Lowering::product(const model::Apply& form) {
    const bool right_first = is_simple(form.operands.back());
    const model::Expr& first_expr = right_first ? form.operands.back() : form.operands.front();
    const model::Expr& other_expr = right_first ? form.operands.front() : form.operands.back();
    const ir::NodeId first = lower(first_expr);
    const bool is_scalar = is_fixed_in_scope(first);
    const ir::NodeId other = is_scalar ? lower_lazily(other_expr) : lower(other_expr);
    const bool is_plain =
        !is_scalar || excludes_zero(builder_.properties(first).range) || keeps_zeros(other);
    if (!is_plain) return product_unless_zero(first, other, right_first);
    const ir::NodeId left = right_first ? other : first;
    const ir::NodeId right = right_first ? first : other;
    return builder_.apply(Operator::Multiply, {left, right});
}

//     select(first == 0, first, first * other), of a bool select(first, other, 0)
//
// A large first factor is not repeated: it gets a name, or, where it must stay in a lazy branch,
// hands the product down into its own second branch: in the first one it is zero already.
ir::NodeId Lowering::product_unless_zero(ir::NodeId first, ir::NodeId other, bool right_first) {
    const ir::NodeId zero = builder_.convert(builder_.constant(false), program_[first].type);
    if (const auto holds = ir::converted_bool(program_, first))
        return builder_.select(*holds, other, zero);
    const auto test = [&](ir::NodeId id) {
        return builder_.apply(Operator::Equal, {id, zero});
    };
    const bool is_large = builder_.properties(first).cost > largest_repeated_cost;
    const auto* select = std::get_if<ir::Select>(&program_[first].form);
    if (is_large && may_be_named(first)) {
        first = named(first);
    } else if (is_large && select) {
        const auto [condition, then_value, else_value, evaluated] = *select;
        if (condition == test(then_value)) {
            const ir::NodeId rest = product_unless_zero(else_value, other, right_first);
            return builder_.select(condition, then_value, rest);
        }
    }
    // The first factor is not zero in the second branch, which the other one need not ask again.
    const auto* asks = std::get_if<ir::Select>(&program_[other].form);
    if (asks && asks->condition == test(first)) other = asks->else_value;
    const ir::NodeId left = right_first ? other : first;
    const ir::NodeId right = right_first ? first : other;
    return builder_.select(test(first), first, builder_.apply(Operator::Multiply, {left, right}));
}

// An expression that may fault keeps its place in a lazy branch, and one that the instance fixes
// stays an expression that bounds and passes can evaluate.
bool Lowering::may_be_named(ir::NodeId value) const {
    const ir::Properties& properties = builder_.properties(value);
    return scope_.empty() && !properties.uniform && (!properties.may_fault || branches_ == 0);
}

// It has one value for all objects of the variables in scope.
bool Lowering::is_fixed_in_scope(ir::NodeId value) const {
    const auto& free = builder_.properties(value).free_variables;
    return std::ranges::none_of(scope_, [&](ir::VariableId variable) {
        return std::ranges::binary_search(free, variable);
    });
}

// A local for a value, outside of any scope.
ir::NodeId Lowering::named(ir::NodeId value) {
    const ir::LocalId local{program_.local_count++};
    prelude_.push_back({ir::Let{local, value}});
    return builder_.local(local, program_[value].type);
}

ir::NodeId Lowering::lower(const model::If& form, const model::Expr&) {
    const ir::NodeId condition = lower(*form.condition);
    const auto values = lower_branches({&*form.then_branch, &*form.else_branch});
    return builder_.select(condition, values[0], values[1]);
}

// A chain of selects, the default (or the last case) at its end.
ir::NodeId Lowering::lower(const model::Switch& form, const model::Expr&) {
    const ir::NodeId subject = lower(*form.subject);
    std::vector<ir::NodeId> labels;  // behind the value that stands at the end
    std::vector<const model::Expr*> branches;
    if (form.default_case) branches.push_back(&**form.default_case);
    for (std::size_t member = form.cases.size(); member-- > 0;) {
        if (!form.cases[member]) continue;
        if (!branches.empty()) labels.push_back(integer(static_cast<std::int64_t>(member)));
        branches.push_back(&**form.cases[member]);
    }
    const std::vector<ir::NodeId> values = lower_branches(branches);
    return choice(subject, labels, std::span(values).subspan(1), values.front());
}

// Labels fall. A long chain is halved, and each half is a choice for itself: later passes recurse
// on expressions.
ir::NodeId Lowering::choice(ir::NodeId subject, std::span<const ir::NodeId> labels,
                            std::span<const ir::NodeId> values, ir::NodeId rest) {
    if (labels.size() > longest_chain) {
        const std::size_t half = labels.size() / 2;
        const ir::NodeId is_high =
            builder_.apply(Operator::GreaterEqual, {subject, labels[half - 1]});
        const ir::NodeId high = choice(subject, labels.first(half), values.first(half), rest);
        const ir::NodeId low = choice(subject, labels.subspan(half), values.subspan(half), rest);
        return builder_.select(is_high, high, low);
    }
    for (std::size_t k = 0; k < labels.size(); ++k)
        rest =
            builder_.select(builder_.apply(Operator::Equal, {subject, labels[k]}), values[k], rest);
    return rest;
}

ir::NodeId Lowering::lower(const model::Aggregate& form, const model::Expr& expr) {
    const auto is_empty = [&](model::VariableId id) {
        return size_of(id) == 0;
    };
    if (needs_an_object(form.op) && std::ranges::any_of(form.variables, is_empty)) {
        const std::string what = fmt::format("{} over no objects", name_of(form.op));
        return builder_.fault(scalar_of(expr.type), new_place(expr, what));
    }
    enter(form.variables);
    const ir::NodeId body = lower(*form.body);
    leave(form.variables.size());
    if (form.op != Reduction::Average) return loops_over(form, form.op, body);

    const ir::NodeId total =
        loops_over(form, Reduction::Sum, builder_.convert(body, ir::Scalar::Real));
    double count = 1;
    for (model::VariableId variable : form.variables) {
        count *= static_cast<double>(size_of(variable));
    }
    return builder_.apply(Operator::Divide, {total, builder_.constant(count)});
}

// One reduction for each variable, the last one innermost. Bools are counted as 0 and 1.
ir::NodeId Lowering::loops_over(const model::Aggregate& form, Reduction op, ir::NodeId body) {
    const bool of_bools = is_quantifier(op);
    if (!of_bools && program_[body].type == ir::Scalar::Bool) {
        body = builder_.convert(body, ir::Scalar::Int);
    }
    for (auto variable = form.variables.rbegin(); variable != form.variables.rend(); ++variable) {
        body = builder_.reduce(op, variable_of(*variable), body);
    }
    return body;
}

// -------------------------------------------------------------------------------------- draws

ir::NodeId Lowering::lower(const model::Sample& form, const model::Expr& expr) {
    if (is_delta(form.distribution)) return lower_as(form.parameters.front(), scalar_of(expr.type));
    std::vector<ir::NodeId> parameters;
    for (const model::Expr& parameter : form.parameters) {
        const bool is_count = takes_int(form.distribution, parameters.size());
        parameters.push_back(lower_as(parameter, is_count ? ir::Scalar::Int : ir::Scalar::Real));
    }
    const ir::Place place = new_draw(expr, std::string(name_of(form.distribution)));
    return builder_.sample(scalar_of(expr.type), form.distribution, place, std::move(parameters));
}

ir::NodeId Lowering::lower(const model::Discrete& form, const model::Expr& expr) {
    std::vector<ir::NodeId> weights;
    for (const model::Expr& weight : form.weights) {
        weights.push_back(lower_as(weight, ir::Scalar::Real));
    }
    const std::string what = form.normalise ? "UnnormDiscrete" : "Discrete";
    const ir::Place place = new_draw(expr, what);
    if (weights.empty()) return builder_.fault(ir::Scalar::Int, place);
    return builder_.discrete(form.normalise, place, std::move(weights));
}

ir::NodeId Lowering::lower(const model::DiscreteOver& form, const model::Expr& expr) {
    const std::string what = form.normalise ? "UnnormDiscrete" : "Discrete";
    const ir::Place place = new_draw(expr, what);
    if (size_of(form.variable) == 0) return builder_.fault(ir::Scalar::Int, place);
    enter(std::span(&form.variable, 1));
    const ir::NodeId weight = lower_as(*form.weight, ir::Scalar::Real);
    leave(1);
    return builder_.discrete_over(form.normalise, place, variable_of(form.variable), weight);
}

}  // namespace rddlc::grounding
