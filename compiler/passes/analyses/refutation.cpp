#include "passes/analyses/refutation.hpp"

#include "support/match.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rddlc::passes {
namespace {

// Disjunctions inside of each other.
constexpr int most_choices = 3;

const LineBounds truth = exactly(1), falsehood = exactly(0), unknown = between(0, 1);

bool is_true(const LineBounds& a) {
    return a.low[0] == 1;
}
bool is_false_bool(const LineBounds& a) {
    return a.high[0] == 0;
}
bool is_known(const LineBounds& a) {
    return is_true(a) || is_false_bool(a);
}
LineBounds bool_of(bool is_certain, bool is_impossible) {
    return is_certain ? truth : is_impossible ? falsehood : unknown;
}
LineBounds negated(const LineBounds& a) {
    return bool_of(is_false_bool(a), is_true(a));
}

LineBounds compared(Operator op, const LineBounds& a, const LineBounds& b) {
    const bool is_less = is_below(a, b), is_greater = is_below(b, a);
    const auto number = only_number(a);
    switch (op) {
        case Operator::Less:
            return bool_of(is_less, is_at_most(b, a));
        case Operator::LessEqual:
            return bool_of(is_at_most(a, b), is_greater);
        case Operator::Greater:
            return bool_of(is_greater, is_at_most(a, b));
        case Operator::GreaterEqual:
            return bool_of(is_at_most(b, a), is_less);
        case Operator::Equal:
            return bool_of(number && number == only_number(b), is_less || is_greater);
        default:
            return negated(compared(Operator::Equal, a, b));
    }
}
bool is_equality(Operator op) {
    return op == Operator::Equal || op == Operator::NotEqual || op == Operator::Equivalent;
}

// a <= b, or a < b.
void narrow_ordered(LineBounds& a, LineBounds& b) {
    narrow(a, {everything().low, b.high});
    narrow(b, {a.low, everything().high});
}
void narrow_equal(LineBounds& a, LineBounds& b) {
    narrow(a, b);
    narrow(b, a);
}
void narrow_comparison(Operator op, bool holds, LineBounds& a, LineBounds& b) {
    switch (op) {
        case Operator::Less:
        case Operator::LessEqual:
            return holds ? narrow_ordered(a, b) : narrow_ordered(b, a);
        case Operator::Greater:
        case Operator::GreaterEqual:
            return holds ? narrow_ordered(b, a) : narrow_ordered(a, b);
        default:
            if (holds == (op == Operator::Equal)) narrow_equal(a, b);
    }
}

// Narrows a factor of a product if the other one is a constant.
void narrow_factor(LineBounds& factor, const LineBounds& other, const LineBounds& product) {
    const auto constant = only_number(other);
    if (!constant || *constant == 0) return;
    LineBounds quotient = *constant < 0 ? negate(product) : product;
    for (Line* const line : {&quotient.low, &quotient.high})
        for (double& end : *line) end /= std::fabs(*constant);
    narrow(factor, before_rounding(quotient));
}

// Operands decide a conjunction or disjunction together, or each of them alone.
void narrow_logic(Operator op, LineBounds& a, LineBounds& b, const LineBounds& result) {
    const LineBounds all = op == Operator::And ? truth : falsehood;
    const auto is_all = op == Operator::And ? is_true : is_false_bool;
    if (!is_known(result)) return;
    if (is_all(result) || is_all(a)) narrow(b, is_all(result) ? all : result);
    if (is_all(result) || is_all(b)) narrow(a, is_all(result) ? all : result);
}
void narrow_bool_equality(bool are_equal, LineBounds& a, LineBounds& b) {
    if (is_known(a)) narrow(b, are_equal ? a : negated(a));
    if (is_known(b)) narrow(a, are_equal ? b : negated(b));
}

}  // namespace

// ------------------------------------------------------------------------------ the condition

struct ConditionOfObjects::Making {
    const ir::Program& program;
    ir::VariableId object;
    std::map<ir::LocalId, ir::NodeId> locals = {};
    std::map<ir::NodeId, std::size_t> made = {};
    ConditionOfObjects condition = {};

    std::optional<std::size_t> term(ir::NodeId id) {
        if (const auto known = made.find(id); known != made.end()) return known->second;
        const ir::Node& node = program[id];
        if (const auto* local = std::get_if<ir::Local>(&node.form)) {
            const auto value = locals.find(local->local);
            return value == locals.end() ? std::nullopt : term(value->second);
        }
        auto made_term = match(
            node.form,
            [&](const ir::Constant& constant) -> std::optional<Term> {
                return constants({&constant.value, 1});
            },
            [&](const ir::Load& load) { return loaded(load); },
            [&](const ir::Apply& apply) { return applied(apply); },
            [&](const ir::Select& select) {
                return with_operands({Form::Select},
                                     {select.condition, select.then_value, select.else_value});
            },
            [](const auto&) -> std::optional<Term> { return std::nullopt; });
        if (!made_term || node.type == ir::Scalar::Int) return std::nullopt;
        made_term->is_bool = node.type == ir::Scalar::Bool;
        condition.terms_.push_back(*std::move(made_term));
        return made[id] = condition.terms_.size() - 1;
    }

    // A value for each object, or one for all.
    static std::optional<Term> constants(std::span<const ir::Value> values) {
        Term term{Form::Constant};
        for (const ir::Value& value : values) {
            if (const auto* real = std::get_if<double>(&value))
                term.constants.push_back(*real);
            else if (const auto* is = std::get_if<bool>(&value))
                term.constants.push_back(*is ? 1 : 0);
            else
                return std::nullopt;
        }
        return term;
    }

    std::optional<Term> loaded(const ir::Load& load) {
        const ir::Buffer& buffer = program[load.buffer];
        if (buffer.storage == ir::Storage::Constant) {
            const bool is_of_object =
                load.indices.size() == 1 && program[load.indices.front()].form ==
                                                ir::Node{ir::Scalar::Int, ir::Index{object}}.form;
            if (!is_of_object) return std::nullopt;
            std::vector<ir::Value> values;
            for (std::int64_t i = 0; i < buffer.count(); ++i) values.push_back(buffer.values[i]);
            return constants(values);
        }
        if (!load.indices.empty() || buffer.scalar != ir::Scalar::Real) return std::nullopt;
        auto& numbers = condition.numbers_;
        const auto found = std::ranges::find(numbers, load.buffer);
        Term term{Form::Number};
        term.number = static_cast<std::size_t>(found - numbers.begin());
        term.degree = 1;
        if (found == numbers.end()) numbers.push_back(load.buffer);
        return term;
    }

    std::optional<Term> applied(const ir::Apply& apply) {
        constexpr Operator known[] = {
            Operator::Add,     Operator::Subtract,     Operator::Multiply, Operator::Negate,
            Operator::Equal,   Operator::NotEqual,     Operator::Less,     Operator::LessEqual,
            Operator::Greater, Operator::GreaterEqual, Operator::And,      Operator::Or,
            Operator::Not,     Operator::Equivalent,   Operator::Abs,      Operator::Minimum,
            Operator::Maximum};
        if (std::ranges::find(known, apply.op) == std::end(known)) return std::nullopt;
        Term term{Form::Apply};
        term.op = apply.op;
        return with_operands(std::move(term), apply.operands);
    }

    std::optional<Term> with_operands(Term made_term, const std::vector<ir::NodeId>& operands) {
        for (const ir::NodeId operand : operands) {
            const auto index = term(operand);
            if (!index) return std::nullopt;
            made_term.operands.push_back(*index);
            const int degree = condition.terms_[*index].degree;
            made_term.degree = made_term.op == Operator::Multiply
                                   ? made_term.degree + degree
                                   : std::max(made_term.degree, degree);
        }
        return made_term;
    }
};

std::optional<ConditionOfObjects> ConditionOfObjects::of(const ir::Program& program,
                                                         std::span<const ir::Statement> lets,
                                                         ir::NodeId condition,
                                                         ir::VariableId object) {
    Making making{program, object};
    for (const ir::Statement& statement : lets) {
        const auto& let = std::get<ir::Let>(statement.form);
        making.locals[let.local] = let.value;
    }
    if (!making.term(condition)) return std::nullopt;
    return std::move(making.condition);
}

std::optional<std::pair<double, double>> ConditionOfObjects::constants_near(
    std::size_t number) const {
    std::vector<double> found;
    for (const Term& term : terms_) {
        if (term.form != Form::Apply || term.operands.size() != 2) continue;
        if (!is_comparison(term.op) && term.op != Operator::Subtract) continue;
        for (std::size_t k = 0; k < 2; ++k) {
            const Term& one = terms_[term.operands[k]];
            const Term& other = terms_[term.operands[1 - k]];
            if (one.form == Form::Number && one.number == number && other.form == Form::Constant &&
                other.constants.size() > 1)
                found.insert(found.end(), other.constants.begin(), other.constants.end());
        }
    }
    if (found.empty()) return std::nullopt;
    const auto [least, greatest] = std::ranges::minmax(found);
    return std::pair(least, greatest);
}

// --------------------------------------------------------------------------- from the numbers

bool ConditionOfObjects::is_false(std::int64_t object, std::span<const LineBounds> numbers) const {
    return is_false_bool(evaluated(object, numbers).back());
}

ConditionOfObjects::Values ConditionOfObjects::evaluated(
    std::int64_t object, std::span<const LineBounds> numbers) const {
    Values values(terms_.size());
    for (std::size_t i = 0; i < terms_.size(); ++i) {
        const Term& term = terms_[i];
        if (term.form == Form::Number)
            values[i] = numbers[term.number];
        else if (term.form == Form::Constant)
            values[i] = exactly(
                term.constants[term.constants.size() == 1 ? 0 : static_cast<std::size_t>(object)]);
        else
            values[i] = value(term, values);
    }
    return values;
}

LineBounds ConditionOfObjects::value(const Term& term, const Values& values) const {
    if (term.form == Form::Select) return selected(term, values);
    const LineBounds& a = values[term.operands.front()];
    const LineBounds& b = values[term.operands.back()];
    const bool of_bools = terms_[term.operands.front()].is_bool;
    switch (term.op) {
        case Operator::Add:
            return add(a, b);
        case Operator::Subtract:
            return subtract(a, b);
        case Operator::Multiply:
            return multiply(a, b);
        case Operator::Negate:
            return negate(a);
        case Operator::Abs:
            return absolute(a);
        case Operator::Minimum:
            return minimum(a, b);
        case Operator::Maximum:
            return maximum(a, b);
        case Operator::And:
            return bool_of(is_true(a) && is_true(b), is_false_bool(a) || is_false_bool(b));
        case Operator::Or:
            return bool_of(is_true(a) || is_true(b), is_false_bool(a) && is_false_bool(b));
        case Operator::Not:
            return negated(a);
        default:
            break;
    }
    if (!of_bools) return compared(term.op, a, b);
    if (!is_known(a) || !is_known(b)) return unknown;
    const bool are_equal = is_true(a) == is_true(b);
    return are_equal != (term.op == Operator::NotEqual) ? truth : falsehood;
}

// select(v == c, v, x) is c where v equals it, as ground makes products of a zero.
LineBounds ConditionOfObjects::selected(const Term& term, const Values& values) const {
    const LineBounds& condition = values[term.operands[0]];
    const LineBounds& else_value = values[term.operands[2]];
    if (is_true(condition)) return values[term.operands[1]];
    if (is_false_bool(condition)) return else_value;
    const Term& test = terms_[term.operands[0]];
    const bool is_tested = test.form == Form::Apply && test.op == Operator::Equal &&
                           test.operands[0] == term.operands[1];
    return join(values[is_tested ? test.operands[1] : term.operands[1]], else_value);
}

// --------------------------------------------------------------------------- by contradiction

bool ConditionOfObjects::is_refuted(std::int64_t object,
                                    std::span<const LineBounds> numbers) const {
    Values values = evaluated(object, numbers);
    if (is_false_bool(values.back())) return true;
    const Terms open = open_terms(values);
    values.back() = truth;
    return leads_to_contradiction(open, std::move(values), 0);
}

// The terms below bools that are not known, operands first.
ConditionOfObjects::Terms ConditionOfObjects::open_terms(const Values& values) const {
    std::vector<bool> is_open(terms_.size());
    is_open.back() = true;
    Terms terms;
    for (std::size_t i = terms_.size(); i-- > 0;) {
        if (!is_open[i]) continue;
        terms.push_back(i);
        if (terms_[i].is_bool && is_known(values[i])) continue;
        for (const std::size_t operand : terms_[i].operands) is_open[operand] = true;
    }
    std::ranges::reverse(terms);
    return terms;
}

// Bounds are narrowed where no choice is left.
bool ConditionOfObjects::leads_to_contradiction(const Terms& open, Values values, int depth) const {
    if (depth == 0 && is_contradictory(open, values)) return true;
    const auto choice = depth < most_choices ? open_choice(open, values) : std::nullopt;
    if (!choice) return is_contradictory(open, values) || is_contradictory(open, values);
    const Term& term = terms_[*choice];
    const bool is_either = !is_equality(term.op);
    for (std::size_t k = 0; k < 2; ++k) {
        Values chosen = values;
        chosen[term.operands[is_either ? k : 0]] = is_either ? values[*choice]
                                                   : k == 0  ? truth
                                                             : falsehood;
        if (!leads_to_contradiction(open, std::move(chosen), depth + 1)) return false;
    }
    return true;
}

// A disjunction that is true, or a conjunction that is false, and it is open which operand makes it
// so; or an equality of bools. Among them, one of the sums before those of products, since they
// narrow more.
std::optional<std::size_t> ConditionOfObjects::open_choice(const Terms& open,
                                                           const Values& values) const {
    std::optional<std::size_t> choice;
    for (const std::size_t i : open) {
        const Term& term = terms_[i];
        if (term.form != Form::Apply || term.operands.size() != 2 ||
            !terms_[term.operands[0]].is_bool)
            continue;
        const bool may_be = (term.op == Operator::Or && is_true(values[i])) ||
                            (term.op == Operator::And && is_false_bool(values[i])) ||
                            (is_equality(term.op) && is_known(values[i]));
        if (!may_be || is_known(values[term.operands[0]]) || is_known(values[term.operands[1]]))
            continue;
        if (!choice || term.degree < terms_[*choice].degree) choice = i;
    }
    return choice;
}

// Goes down to the numbers and up again, once.
bool ConditionOfObjects::is_contradictory(const Terms& open, Values& values) const {
    for (std::size_t k = open.size(); k-- > 0;) narrow_operands(terms_[open[k]], values);
    for (const std::size_t i : open) {
        const Form form = terms_[i].form;
        const bool is_computed = form == Form::Apply || form == Form::Select;
        if (is_computed) narrow(values[i], value(terms_[i], values));
        if (is_empty(values[i])) return true;
    }
    return false;
}

void ConditionOfObjects::narrow_operands(const Term& term, Values& values) const {
    if (term.form == Form::Constant || term.form == Form::Number) return;
    const LineBounds result = values[static_cast<std::size_t>(&term - terms_.data())];
    if (term.form == Form::Select) return narrow_branches(term, result, values);
    LineBounds& a = values[term.operands.front()];
    LineBounds& b = values[term.operands.back()];
    const LineBounds exact = before_rounding(result);
    switch (term.op) {
        case Operator::Add:
            narrow(a, subtract(exact, b));
            return narrow(b, subtract(exact, a));
        case Operator::Subtract:
            narrow(a, add(exact, b));
            return narrow(b, subtract(a, exact));
        case Operator::Multiply:
            narrow_factor(a, b, exact);
            return narrow_factor(b, a, exact);
        case Operator::Negate:
            return narrow(a, negate(result));
        case Operator::Not:
            return narrow(a, negated(result));
        case Operator::Abs:
            return narrow(a, {negate(result).low, result.high});
        case Operator::Minimum:
            narrow(a, {result.low, everything().high});
            return narrow(b, {result.low, everything().high});
        case Operator::Maximum:
            narrow(a, {everything().low, result.high});
            return narrow(b, {everything().low, result.high});
        case Operator::And:
        case Operator::Or:
            return narrow_logic(term.op, a, b, result);
        default:
            break;
    }
    if (!is_known(result)) return;
    if (terms_[term.operands.front()].is_bool)
        narrow_bool_equality(is_true(result) != (term.op == Operator::NotEqual), a, b);
    else
        narrow_comparison(term.op, is_true(result), a, b);
}

void ConditionOfObjects::narrow_branches(const Term& term, const LineBounds& result,
                                         Values& values) const {
    LineBounds& condition = values[term.operands[0]];
    LineBounds& then_value = values[term.operands[1]];
    if (is_true(condition)) return narrow(then_value, result);
    if (is_false_bool(condition)) return narrow(values[term.operands[2]], result);
    const bool is_not_taken = term.is_bool && is_known(result) && is_known(then_value) &&
                              is_true(result) != is_true(then_value);
    if (is_not_taken) narrow(condition, falsehood);
}

}  // namespace rddlc::passes
