#include "passes/analyses/sparsity_pattern.hpp"

#include "support/match.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace rddlc::passes {
namespace {

// Tables in which most elements are exceptions are looked through up to this size.
constexpr std::int64_t most_examined_elements = std::int64_t{1} << 22;
// Relations with more of all possible tuples than this do not help.
constexpr double sparse_enough = 0.5;

bool is_zero(const ir::Value& value) {
    return as_real(value) == 0;
}

ir::Value opposite(const ir::Value& value) {
    return !std::get<bool>(value);
}

// The operand whose conversion gives `value`, for the few values that matter.
std::optional<ir::Value> before_conversion(const ir::Value& value, ir::Scalar from) {
    const double number = as_real(value);
    if (number != 0 && number != 1) return std::nullopt;
    if (from == ir::Scalar::Int) return static_cast<std::int64_t>(number);
    return number == 1;
}

bool is_sparse(const Relation& relation) {
    const auto all = volume(relation.axes);
    return !all ||
           static_cast<double>(relation.count()) <= sparse_enough * static_cast<double>(*all);
}

void add_new(std::vector<ir::NodeId>& nodes, const std::vector<ir::NodeId>& others) {
    std::ranges::copy_if(others, std::back_inserter(nodes), [&](ir::NodeId id) {
        return std::ranges::find(nodes, id) == nodes.end();
    });
}

}  // namespace

SparsityPattern::SparsityPattern(const ir::Builder& builder, const ir::Evaluator& evaluator)
    : builder_(builder), evaluator_(evaluator) {}

std::optional<Relation> SparsityPattern::of(ir::NodeId id, const ir::Value& value) {
    const ir::Node& node = program()[id];
    const auto all = volume(axes_of(id));
    if (properties(id).uniform && all && affords(id, static_cast<double>(*all))) {
        return by_trying_all(id, value);
    }
    Found found = match(
        node.form, [&](const ir::Load& form) { return of(form, value); },
        [&](const ir::Convert& form) { return of(form, value); },
        [&](const ir::Apply& form) { return of(form, value); },
        [&](const ir::Select& form) { return of(form, value); },
        [&](const ir::Reduce& form) { return of(form, value); },
        [&](const ir::Sample& form) { return of(form, value); },
        [](const auto&) { return Found(); });
    if (!found && properties(id).uniform) found = of_common_elements(id, value);
    if (found && !is_sparse(*found)) found.reset();
    return found;
}

std::optional<Relation> SparsityPattern::of_term(ir::NodeId id, std::vector<ir::NodeId>& doubtful) {
    if (program()[id].type != ir::Scalar::Real) return std::nullopt;
    if (const Found found = of(id, 0.0)) return found;
    return match(
        program()[id].form,
        [&](const ir::Apply& form) {
            const ir::NodeId a = form.operands.front(), b = form.operands.back();
            if (form.op == Operator::Divide && is_never_zero(b)) return of_term(a, doubtful);
            if (form.op != Operator::Multiply) return Found();
            const Found found = of_doubtful_product(a, b, doubtful);
            return found ? found : of_doubtful_product(b, a, doubtful);
        },
        [&](const ir::Select& form) {
            if (!ir::is_guarded_product(program(), form)) return Found();
            // Where the tested factor is zero, the other one may be anything.
            std::vector<ir::NodeId> inner;
            const Found found = of_term(form.else_value, inner);
            if (inner != std::vector{form.then_value}) return Found();
            add_new(doubtful, inner);
            return found;
        },
        [&](const ir::Reduce& form) {
            if (form.op != Reduction::Sum || form.bounds) return Found();
            std::vector<ir::NodeId> inner;
            const Found inside = of_term(form.body, inner);
            if (!inside || depend(inner, form.variable)) return Found();
            add_new(doubtful, inner);
            return std::optional(project(*inside, form.variable));
        },
        [](const auto&) { return Found(); });
}

// The pattern of the zeros of `a`, if `b` is not known to be finite.
std::optional<Relation> SparsityPattern::of_doubtful_product(ir::NodeId a, ir::NodeId b,
                                                             std::vector<ir::NodeId>& doubtful) {
    if (properties(b).may_fault) return std::nullopt;
    const Found found = of_term(a, doubtful);
    if (found && !properties(b).finite) add_new(doubtful, {b});
    return found;
}

// ------------------------------------------------------------------------------- evaluation

std::optional<ir::Value> SparsityPattern::evaluate(ir::NodeId id, std::span<const Axis> axes,
                                                   std::int64_t tuple) const {
    Context context;
    ir::Evaluator::Frame frame(evaluator_, {}, context);
    for (std::size_t k = axes.size(); k-- > 0;) {
        frame.set(axes[k].variable, tuple % axes[k].size);
        tuple /= axes[k].size;
    }
    return evaluator_.value_unless_fault(id, frame);
}

std::optional<Relation> SparsityPattern::by_trying_all(ir::NodeId id, const ir::Value& value) {
    Relation result{axes_of(id), {}};
    for (std::int64_t tuple = 0; tuple < *volume(result.axes); ++tuple) {
        const auto found = evaluate(id, result.axes, tuple);
        if (found != value) result.tuples.push_back(tuple);
    }
    if (!is_sparse(result)) return std::nullopt;
    return result;
}

// The relation without the tuples for which the node is known to have that value.
Relation SparsityPattern::narrowed(Relation relation, ir::NodeId id, const ir::Value& value) {
    const auto is_known = [&](ir::VariableId variable) {
        return relation.has(variable);
    };
    const bool possible = properties(id).uniform &&
                          std::ranges::all_of(properties(id).free_variables, is_known) &&
                          affords(id, static_cast<double>(relation.count()));
    if (!possible) return relation;
    std::erase_if(relation.tuples, [&](std::int64_t tuple) {
        const auto found = evaluate(id, relation.axes, tuple);
        return found == value;
    });
    return relation;
}

bool SparsityPattern::depend(std::span<const ir::NodeId> nodes, ir::VariableId variable) const {
    return std::ranges::any_of(
        nodes, [&](ir::NodeId id) { return ir::depends_on(properties(id), variable); });
}

bool SparsityPattern::affords(ir::NodeId id, double times) {
    return budget_.pay(std::max(properties(id).cost, 1.0) * times);
}

std::vector<Axis> SparsityPattern::axes_of(ir::NodeId id) const {
    std::vector<Axis> axes;
    for (ir::VariableId variable : properties(id).free_variables) {
        axes.push_back({variable, program()[variable].size});
    }
    return axes;
}

// ---------------------------------------------------------------------------------- tables

std::optional<Relation> SparsityPattern::of(const ir::Load& load, const ir::Value& value) {
    const ir::Buffer& table = program()[load.buffer];
    if (table.storage != ir::Storage::Constant) return std::nullopt;
    std::vector<Axis> axes;           // of the table
    std::vector<ir::VariableId> any;  // stand for indices that may choose any element
    for (std::size_t k = 0; k < load.indices.size(); ++k) {
        const ir::NodeId index = load.indices[k];
        if (const auto* variable = std::get_if<ir::Index>(&program()[index].form)) {
            axes.push_back({variable->variable, program()[variable->variable].size});
        } else if (properties(index).may_fault || properties(index).uniform) {
            return std::nullopt;
        } else {
            any.push_back({static_cast<std::uint32_t>(program().variables.size() + k)});
            axes.push_back({any.back(), table.shape[k]});
        }
    }
    std::vector<Axis> sorted = axes;
    std::ranges::sort(sorted);
    if (std::ranges::adjacent_find(sorted) != sorted.end()) return std::nullopt;
    Relation result{std::move(axes), {}};
    if (table.values.common() == value) {
        for (const auto& [index, exception] : table.values.exceptions()) {
            if (exception != value) result.tuples.push_back(index);
        }
    } else {
        if (table.values.size() > most_examined_elements) return std::nullopt;
        for (std::int64_t i = 0; i < table.values.size(); ++i) {
            if (table.values[i] != value) result.tuples.push_back(i);
        }
    }
    result = ordered(result, std::move(sorted));
    for (const ir::VariableId variable : any) result = project(result, variable);
    if (!is_sparse(result)) return std::nullopt;
    return result;
}

// Where all tables have their common elements, the expression has one value: if it is the given
// one, then the exceptions are among those of the tables.
std::optional<Relation> SparsityPattern::of_common_elements(ir::NodeId id, const ir::Value& value) {
    const Found found = entries_of_tables(id);
    if (!found || !is_sparse(*found)) return std::nullopt;
    const Found all = unite(Relation{axes_of(id), {}}, *found);
    if (!all) return std::nullopt;
    std::int64_t common = 0;  // a tuple that is no exception
    while (common < all->count() && all->tuples[static_cast<std::size_t>(common)] == common) {
        ++common;
    }
    if (common == volume(all->axes) || evaluate(id, all->axes, common) != value) return {};
    return narrowed(*all, id, value);
}

// The assignments for which some table of the expression does not have its common element. Nothing
// if objects are used for more than choosing elements.
std::optional<Relation> SparsityPattern::entries_of_tables(ir::NodeId id) {
    const ir::Node& node = program()[id];
    if (properties(id).free_variables.empty()) return Relation{};
    if (std::holds_alternative<ir::Index>(node.form)) return std::nullopt;
    if (const auto* load = std::get_if<ir::Load>(&node.form)) {
        return of(*load, program()[load->buffer].values.common());
    }
    if (ir::bound_variable(node)) return std::nullopt;
    Found all = Relation{};
    for (ir::NodeId operand : ir::operands_of(node)) {
        const Found some = entries_of_tables(operand);
        if (!some) return std::nullopt;
        all = unite(*all, *some);
        if (!all) return std::nullopt;
    }
    return all;
}

// ----------------------------------------------------------------------------- expressions

std::optional<Relation> SparsityPattern::of(const ir::Convert& convert, const ir::Value& value) {
    const auto before = before_conversion(value, program()[convert.operand].type);
    return before ? of(convert.operand, *before) : std::nullopt;
}

std::optional<Relation> SparsityPattern::of(const ir::Apply& apply, const ir::Value& value) {
    const ir::NodeId a = apply.operands.front();
    const ir::NodeId b = apply.operands.back();
    const Operator op = apply.op;
    if (op == Operator::Not) return of(a, opposite(value));
    if (is_one_of(op, {Operator::And, Operator::Or}))
        return std::get<bool>(value) == (op == Operator::And) ? either(a, b, value)
                                                              : both(a, value, b, value);
    if (is_one_of(op, {Operator::Equal, Operator::NotEqual}))
        return value == ir::Value(op == Operator::Equal) ? std::nullopt : of_equality(a, b);
    if (is_one_of(op, {Operator::Minimum, Operator::Maximum})) return either(a, b, value);
    if (!is_zero(value)) return of_zero_beside(apply, value);
    if (op == Operator::Multiply) return of_product(a, b, value);
    if (op == Operator::Divide) return is_never_zero(b) ? of(a, value) : std::nullopt;
    if (is_one_of(op, {Operator::Add, Operator::Subtract})) return either(a, b, value);
    return op == Operator::Negate ? of(a, value) : std::nullopt;
}

// A zero divided by such a number is a zero.
bool SparsityPattern::is_never_zero(ir::NodeId divisor) const {
    return excludes_zero(properties(divisor).range) && !properties(divisor).may_fault;
}

// `1.0 - x` differs from 1.0 only where x differs from a zero.
std::optional<Relation> SparsityPattern::of_zero_beside(const ir::Apply& apply,
                                                        const ir::Value& value) {
    const ir::NodeId a = apply.operands.front(), b = apply.operands.back();
    const auto is_value = [&](ir::NodeId id) {
        const auto* constant = std::get_if<ir::Constant>(&program()[id].form);
        return constant && as_real(constant->value) == as_real(value);
    };
    if (!is_one_of(apply.op, {Operator::Add, Operator::Subtract})) return std::nullopt;
    const auto* const is_int = std::get_if<std::int64_t>(&value);
    const ir::Value zero = is_int ? ir::Value(std::int64_t{0}) : ir::Value(0.0);
    if (is_value(a)) return of(b, zero);
    return apply.op == Operator::Add && is_value(b) ? of(a, zero) : std::nullopt;
}

// Compares a loop index with a value that does not depend on it, so there is one such index for
// each value.
std::optional<Relation> SparsityPattern::of_equality(ir::NodeId a, ir::NodeId b) {
    const auto* index = std::get_if<ir::Index>(&program()[a].form);
    if (!index) {
        index = std::get_if<ir::Index>(&program()[b].form);
        std::swap(a, b);
    }
    if (!index || !properties(b).uniform || ir::depends_on(properties(b), index->variable))
        return std::nullopt;
    std::vector<Axis> axes = axes_of(b);
    const auto all = volume(axes);
    if (!all || !affords(b, static_cast<double>(*all))) return std::nullopt;
    const Axis last{index->variable, program()[index->variable].size};
    Relation result{axes, {}};
    result.axes.push_back(last);
    for (std::int64_t tuple = 0; tuple < *all; ++tuple) {
        const auto value = evaluate(b, axes, tuple);
        if (!value) return std::nullopt;
        const auto object = std::get<std::int64_t>(*value);
        if (object < 0 || object >= last.size) continue;
        result.tuples.push_back(tuple * last.size + object);
    }
    axes.push_back(last);
    std::ranges::sort(axes);
    return ordered(result, std::move(axes));
}

// 0 * x is 0 if x is finite, and does not fault if x does not.
std::optional<Relation> SparsityPattern::of_product(ir::NodeId a, ir::NodeId b,
                                                    const ir::Value& zero) {
    const auto is_harmless = [&](ir::NodeId id) {
        return properties(id).finite && !properties(id).may_fault;
    };
    if (is_harmless(a) && is_harmless(b)) return both(a, zero, b, zero);
    if (is_harmless(b)) return of(a, zero);
    if (is_harmless(a)) return of(b, zero);
    return std::nullopt;
}

std::optional<Relation> SparsityPattern::of(const ir::Select& select, const ir::Value& value) {
    if (properties(select.condition).may_fault) return std::nullopt;
    if (is_zero(value) && ir::is_guarded_product(program(), select))
        return of(select.else_value, value);
    const Found first = both(select.condition, false, select.then_value, value);
    if (!first) return std::nullopt;
    const Found second = both(select.condition, true, select.else_value, value);
    if (!second) return std::nullopt;
    return unite(*first, *second);
}

// Combining that value with itself gives it again.
std::optional<Relation> SparsityPattern::of(const ir::Reduce& reduce, const ir::Value& value) {
    if (reduce.bounds) return std::nullopt;
    switch (reduce.op) {
        case Reduction::ForAll:
        case Reduction::Exists:
        case Reduction::Minimum:
        case Reduction::Maximum:
            break;
        case Reduction::Sum:
            if (!is_zero(value)) return std::nullopt;
            break;
        case Reduction::Product:
            if (as_real(value) != 1) return std::nullopt;
            break;
        case Reduction::Average:
        case Reduction::ArgMin:
        case Reduction::ArgMax:
            return std::nullopt;
    }
    const Found inside = of(reduce.body, value);
    if (!inside) return std::nullopt;
    return project(*inside, reduce.variable);
}

// A coin that always falls on one side, as its probability is 0.
std::optional<Relation> SparsityPattern::of(const ir::Sample& sample, const ir::Value& value) {
    if (sample.distribution != Distribution::Bernoulli || std::get<bool>(value)) {
        return std::nullopt;
    }
    return of(sample.parameters.front(), 0.0);
}

// --------------------------------------------------------------------------- combinations

// The pattern of an operator that has the value wherever both operands have it.
std::optional<Relation> SparsityPattern::either(ir::NodeId a, ir::NodeId b,
                                                const ir::Value& value) {
    const Found first = of(a, value);
    if (!first) return std::nullopt;
    const Found second = of(b, value);
    if (!second) return std::nullopt;
    return unite(*first, *second);
}

// The relation of something that has its value wherever one operand has the one given for it. `a`
// is always evaluated, so where it may fault only its own exceptions count; `b` only cannot fault,
// or is evaluated only where `a` is an exception.
std::optional<Relation> SparsityPattern::both(ir::NodeId a, const ir::Value& value_of_a,
                                              ir::NodeId b, const ir::Value& value_of_b) {
    if (properties(a).may_fault) return of(a, value_of_a);
    const Found first = of(a, value_of_a);
    const Found second = of(b, value_of_b);
    if (first && second) return join(*first, *second);
    if (first) return narrowed(*first, b, value_of_b);
    if (second) return narrowed(*second, a, value_of_a);
    return std::nullopt;
}

}  // namespace rddlc::passes
