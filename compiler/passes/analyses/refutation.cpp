#include "passes/analyses/refutation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

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
    if (op == Operator::Less) return bool_of(is_less, is_at_most(b, a));
    if (op == Operator::LessEqual) return bool_of(is_at_most(a, b), is_greater);
    if (op == Operator::Greater) return bool_of(is_greater, is_at_most(a, b));
    if (op == Operator::GreaterEqual) return bool_of(is_at_most(b, a), is_less);
    const auto number = only_number(a);
    const bool are_equal = number && number == only_number(b);
    const LineBounds equal = bool_of(are_equal, is_less || is_greater);
    return op == Operator::Equal ? equal : negated(equal);
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
    const bool is_equal_to = op == Operator::Equal;
    if (is_equal_to || op == Operator::NotEqual) {
        if (holds == is_equal_to) narrow_equal(a, b);
        return;
    }
    const bool is_from_below = op == Operator::Less || op == Operator::LessEqual;
    return holds == is_from_below ? narrow_ordered(a, b) : narrow_ordered(b, a);
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

// All operands of a conjunction that is true are true. If it is false, and one operand is true, the
// other one is false. A disjunction is the same with true and false exchanged.
void narrow_logic(Operator op, LineBounds& a, LineBounds& b, const LineBounds& result) {
    const auto is_all = op == Operator::And ? is_true : is_false_bool;
    if (!is_known(result)) return;
    if (is_all(result) || is_all(a)) narrow(b, result);
    if (is_all(result) || is_all(b)) narrow(a, result);
}
void narrow_bool_equality(bool are_equal, LineBounds& a, LineBounds& b) {
    if (is_known(a)) narrow(b, are_equal ? a : negated(a));
    if (is_known(b)) narrow(a, are_equal ? b : negated(b));
}

class Refutation {
  public:
    explicit Refutation(const ObjectCondition& condition) : condition_(condition) {}

    bool is_false(std::int64_t object, std::span<const LineBounds> numbers) const {
        const std::optional<Values> values = evaluated(object, numbers);
        return values && is_false_bool(values->back());
    }

    bool is_refuted(std::int64_t object, std::span<const LineBounds> numbers) const {
        std::optional<Values> values = evaluated(object, numbers);
        if (!values) return false;
        if (is_false_bool(values->back())) return true;
        const Terms open = open_terms(*values);
        values->back() = truth;
        return leads_to_contradiction(open, *std::move(values), 0);
    }

  private:
    using Form = ObjectCondition::Form;
    using Term = ObjectCondition::Term;
    using Values = std::vector<LineBounds>;  // of all terms
    using Terms = std::vector<std::size_t>;

    // Nothing if a value may overflow: a difference of infinities is not a number, of which bounds
    // say nothing.
    std::optional<Values> evaluated(std::int64_t object,
                                    std::span<const LineBounds> numbers) const {
        Values values(condition_.terms.size());
        for (std::size_t i = 0; i < condition_.terms.size(); ++i) {
            const Term& term = condition_.terms[i];
            if (term.form == Form::Number)
                values[i] = numbers[term.number];
            else if (term.form == Form::Constant)
                values[i] = exactly(
                    term.constants[term.constants.size() == 1 ? 0
                                                              : static_cast<std::size_t>(object)]);
            else
                values[i] = value(term, values);
            if (!is_finite(values[i])) return std::nullopt;
        }
        return values;
    }

    LineBounds value(const Term& term, const Values& values) const {
        if (term.form == Form::Select) return selected(term, values);
        const LineBounds& a = values[term.operands.front()];
        const LineBounds& b = values[term.operands.back()];
        if (term.op == Operator::Add) return add(a, b);
        if (term.op == Operator::Subtract) return subtract(a, b);
        if (term.op == Operator::Multiply) return multiply(a, b);
        if (term.op == Operator::Negate) return negate(a);
        if (term.op == Operator::Abs) return absolute(a);
        if (term.op == Operator::Minimum) return minimum(a, b);
        if (term.op == Operator::Maximum) return maximum(a, b);
        if (term.op == Operator::Not) return negated(a);
        if (term.op == Operator::And)
            return bool_of(is_true(a) && is_true(b), is_false_bool(a) || is_false_bool(b));
        if (term.op == Operator::Or)
            return bool_of(is_true(a) || is_true(b), is_false_bool(a) && is_false_bool(b));
        if (!condition_.terms[term.operands.front()].is_bool) return compared(term.op, a, b);
        if (!is_known(a) || !is_known(b)) return unknown;
        const bool are_equal = is_true(a) == is_true(b);
        return are_equal != (term.op == Operator::NotEqual) ? truth : falsehood;
    }

    // select(v == c, v, x) is c where v equals it, as ground makes products of a zero.
    LineBounds selected(const Term& term, const Values& values) const {
        const LineBounds& condition = values[term.operands[0]];
        const LineBounds& else_value = values[term.operands[2]];
        if (is_true(condition)) return values[term.operands[1]];
        if (is_false_bool(condition)) return else_value;
        const Term& test = condition_.terms[term.operands[0]];
        const bool is_tested = test.form == Form::Apply && test.op == Operator::Equal &&
                               test.operands[0] == term.operands[1];
        return join(values[is_tested ? test.operands[1] : term.operands[1]], else_value);
    }

    // The terms below bools that are not known, operands first.
    Terms open_terms(const Values& values) const {
        std::vector<bool> is_open(condition_.terms.size());
        is_open.back() = true;
        Terms terms;
        for (std::size_t i = condition_.terms.size(); i-- > 0;) {
            if (!is_open[i]) continue;
            terms.push_back(i);
            if (condition_.terms[i].is_bool && is_known(values[i])) continue;
            for (const std::size_t operand : condition_.terms[i].operands) is_open[operand] = true;
        }
        std::ranges::reverse(terms);
        return terms;
    }

    // Bounds are narrowed where no choice is left.
    bool leads_to_contradiction(const Terms& open, Values values, int depth) const {
        if (depth == 0 && is_contradictory(open, values)) return true;
        const auto choice = depth < most_choices ? open_choice(open, values) : std::nullopt;
        if (!choice) return is_contradictory(open, values) || is_contradictory(open, values);
        const Term& term = condition_.terms[*choice];
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

    // A disjunction that is true, or a conjunction that is false, and it is open which operand
    // makes it so; or an equality of bools. Among them, one of the sums before those of products,
    // since they narrow more.
    std::optional<std::size_t> open_choice(const Terms& open, const Values& values) const {
        std::optional<std::size_t> choice;
        for (const std::size_t i : open) {
            const Term& term = condition_.terms[i];
            if (term.form != Form::Apply || term.operands.size() != 2 ||
                !condition_.terms[term.operands[0]].is_bool)
                continue;
            const bool may_be = (term.op == Operator::Or && is_true(values[i])) ||
                                (term.op == Operator::And && is_false_bool(values[i])) ||
                                (is_equality(term.op) && is_known(values[i]));
            if (!may_be || is_known(values[term.operands[0]]) || is_known(values[term.operands[1]]))
                continue;
            if (!choice || term.degree < condition_.terms[*choice].degree) choice = i;
        }
        return choice;
    }

    // Goes down to the numbers and up again, once.
    bool is_contradictory(const Terms& open, Values& values) const {
        for (std::size_t k = open.size(); k-- > 0;) narrow_operands(open[k], values);
        for (const std::size_t i : open) {
            const Form form = condition_.terms[i].form;
            const bool is_computed = form == Form::Apply || form == Form::Select;
            if (is_computed) narrow(values[i], value(condition_.terms[i], values));
            if (is_empty(values[i])) return true;
        }
        return false;
    }

    void narrow_operands(std::size_t index, Values& values) const {
        const Term& term = condition_.terms[index];
        const LineBounds result = values[index];
        if (term.form == Form::Select) return narrow_branches(term, result, values);
        if (term.form != Form::Apply) return;
        LineBounds& a = values[term.operands.front()];
        LineBounds& b = values[term.operands.back()];
        if (term.is_bool) return narrow_compared(term, result, a, b);
        const LineBounds exact = before_rounding(result);
        if (term.op == Operator::Add) {
            narrow(a, subtract(exact, b));
            narrow(b, subtract(exact, a));
        } else if (term.op == Operator::Subtract) {
            narrow(a, add(exact, b));
            narrow(b, subtract(a, exact));
        } else if (term.op == Operator::Multiply) {
            narrow_factor(a, b, exact);
            narrow_factor(b, a, exact);
        } else if (term.op == Operator::Negate) {
            narrow(a, negate(result));
        } else if (term.op == Operator::Abs) {
            narrow(a, {negate(result).low, result.high});
        } else if (term.op == Operator::Minimum) {
            narrow(a, {result.low, everything().high});
            narrow(b, {result.low, everything().high});
        } else if (term.op == Operator::Maximum) {
            narrow(a, {everything().low, result.high});
            narrow(b, {everything().low, result.high});
        }
    }

    void narrow_compared(const Term& term, const LineBounds& result, LineBounds& a,
                         LineBounds& b) const {
        if (!is_known(result)) return;
        if (term.op == Operator::Not) return narrow(a, negated(result));
        if (term.op == Operator::And || term.op == Operator::Or)
            return narrow_logic(term.op, a, b, result);
        if (condition_.terms[term.operands.front()].is_bool)
            return narrow_bool_equality(is_true(result) != (term.op == Operator::NotEqual), a, b);
        narrow_comparison(term.op, is_true(result), a, b);
    }

    void narrow_branches(const Term& term, const LineBounds& result, Values& values) const {
        LineBounds& condition = values[term.operands[0]];
        LineBounds& then_value = values[term.operands[1]];
        if (is_true(condition)) return narrow(then_value, result);
        if (is_false_bool(condition)) return narrow(values[term.operands[2]], result);
        const bool is_not_taken = term.is_bool && is_known(result) && is_known(then_value) &&
                                  is_true(result) != is_true(then_value);
        if (is_not_taken) narrow(condition, falsehood);
    }

    const ObjectCondition& condition_;
};

}  // namespace

bool is_false_within(const ObjectCondition& condition, std::int64_t object,
                     std::span<const LineBounds> bounds) {
    return Refutation(condition).is_false(object, bounds);
}
bool is_refuted_within(const ObjectCondition& condition, std::int64_t object,
                       std::span<const LineBounds> bounds) {
    return Refutation(condition).is_refuted(object, bounds);
}

}  // namespace rddlc::passes
