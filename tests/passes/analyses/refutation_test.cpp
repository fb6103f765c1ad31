// Conditions that are drawn: what is refuted within bounds is false wherever it is tried there.
#include "passes/analyses/refutation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace rddlc::passes {
namespace {

using Form = ObjectCondition::Form;
using Term = ObjectCondition::Term;

constexpr std::size_t number_count = 3;

// R is the type in which a condition is computed.
template <class R>
class Drawing {
  public:
    explicit Drawing(std::uint64_t seed) : random_(seed) {}

    std::size_t below(std::size_t count) { return random_() % count; }
    template <class T>
    T one_of(const std::vector<T>& values) {
        return values[below(values.size())];
    }
    double between_ends(double low, double high) {
        const std::size_t how = below(4);
        if (how < 2) return how == 0 ? low : high;
        return std::clamp(std::uniform_real_distribution(low, high)(random_), low, high);
    }
    // Sums of quarters are exact, and often equal; others are rounded.
    double constant() {
        const R quarters = R{0.25} * (static_cast<R>(below(17)) - 8);
        return one_of<R>({quarters, quarters, quarters / 3, std::ldexp(quarters, -40), R{0}});
    }

    ObjectCondition condition() {
        ObjectCondition result;
        result.numbers.resize(number_count);
        std::size_t all = add_bool(result, 1);
        for (int k = 0; k < 3; ++k) {
            Term both{Form::Apply, Operator::And, {all, add_bool(result, 1)}};
            both.is_bool = true;
            all = add(result, std::move(both));
        }
        return result;
    }

    // The parameter of all bounds, or its negative.
    LineBounds parameter() {
        const double least = std::ldexp(1, -static_cast<int>(below(30)));
        const Line size = {least, below(2) == 0 ? 4 * least : 1 + least};
        return below(2) == 0 ? LineBounds{size, size} : negate({size, size});
    }
    LineBounds bounds() {
        const double one = constant(), other = one_of<double>({one, constant(), one + 0.01});
        return between(std::min(one, other), std::max(one, other));
    }

  private:
    std::size_t add(ObjectCondition& to, Term term) {
        to.terms.push_back(std::move(term));
        return to.terms.size() - 1;
    }
    std::size_t add_bool(ObjectCondition& to, int depth) {
        Term term{depth > 0 && below(9) == 0 ? Form::Select : Form::Apply};
        term.is_bool = true;
        if (term.form == Form::Select) {
            for (int k = 0; k < 3; ++k) term.operands.push_back(add_bool(to, depth - 1));
        } else if (depth == 0 || below(5) == 0) {
            term.op =
                one_of<Operator>({Operator::Less, Operator::LessEqual, Operator::Greater,
                                  Operator::GreaterEqual, Operator::Equal, Operator::NotEqual});
            for (int k = 0; k < 2; ++k) term.operands.push_back(add_real(to, 1 + below(2)));
        } else {
            term.op = one_of<Operator>({Operator::And, Operator::And, Operator::Or, Operator::Not,
                                        Operator::NotEqual, Operator::Equivalent});
            for (int k = 0; k < (term.op == Operator::Not ? 1 : 2); ++k)
                term.operands.push_back(add_bool(to, depth - 1));
        }
        return add(to, std::move(term));
    }
    std::size_t add_real(ObjectCondition& to, std::size_t depth) {
        // Often one that is compared already, so that comparisons contradict each other.
        if (const std::size_t old = below(to.terms.size() + 3); old < to.terms.size())
            if (!to.terms[old].is_bool) return old;
        if (depth == 0 || below(3) == 0) {
            Term term{below(2) == 0 ? Form::Constant : Form::Number};
            if (term.form == Form::Constant) term.constants = {constant()};
            term.number = below(number_count);
            return add(to, std::move(term));
        }
        Term term{below(12) == 0 ? Form::Select : Form::Apply};
        if (term.form == Form::Select) {
            term.operands = {add_bool(to, 0), add_real(to, depth - 1), add_real(to, depth - 1)};
            return add(to, std::move(term));
        }
        term.op = one_of<Operator>({Operator::Add, Operator::Subtract, Operator::Subtract,
                                    Operator::Multiply, Operator::Multiply, Operator::Negate,
                                    Operator::Abs, Operator::Minimum, Operator::Maximum});
        const bool is_unary = term.op == Operator::Negate || term.op == Operator::Abs;
        for (int k = 0; k < (is_unary ? 1 : 2); ++k)
            term.operands.push_back(add_real(to, depth - 1));
        // Also the square of one number.
        if (!is_unary && below(4) == 0) term.operands[1] = term.operands[0];
        return add(to, std::move(term));
    }

    std::mt19937_64 random_;
};

template <class R>
R applied(Operator op, R a, R b) {
    switch (op) {
        case Operator::Add:
            return a + b;
        case Operator::Subtract:
            return a - b;
        case Operator::Multiply:
            return a * b;
        case Operator::Negate:
            return -a;
        case Operator::Abs:
            return std::fabs(a);
        case Operator::Minimum:
            return std::min(a, b);
        case Operator::Maximum:
            return std::max(a, b);
        case Operator::Less:
            return a < b;
        case Operator::LessEqual:
            return a <= b;
        case Operator::Greater:
            return a > b;
        case Operator::GreaterEqual:
            return a >= b;
        case Operator::And:
            return a != 0 && b != 0;
        case Operator::Or:
            return a != 0 || b != 0;
        case Operator::Not:
            return a == 0;
        case Operator::NotEqual:
            return a != b;
        default:
            return a == b;
    }
}

template <class R>
bool holds(const ObjectCondition& condition, const std::vector<R>& numbers) {
    std::vector<R> values;
    for (const Term& term : condition.terms) {
        const auto operand = [&](std::size_t k) {
            return values[term.operands[k]];
        };
        if (term.form == Form::Constant)
            values.push_back(static_cast<R>(term.constants.front()));
        else if (term.form == Form::Number)
            values.push_back(numbers[term.number]);
        else if (term.form == Form::Select)
            values.push_back(operand(0) != 0 ? operand(1) : operand(2));
        else
            values.push_back(applied<R>(term.op, operand(0), values[term.operands.back()]));
    }
    return values.back() != 0;
}

template <class R>
void try_conditions(std::uint64_t count) {
    std::uint64_t refuted = 0, only_by_contradiction = 0;
    for (std::uint64_t seed = 0; seed < count; ++seed) {
        Drawing<R> draw(seed);
        const ObjectCondition condition = draw.condition();
        std::vector<LineBounds> bounds = {draw.parameter()};
        while (bounds.size() < number_count) bounds.push_back(draw.bounds());
        const bool is_false = is_false_within(condition, 0, bounds);
        if (!is_false && !is_refuted_within(condition, 0, bounds)) continue;
        ++refuted;
        only_by_contradiction += !is_false;
        for (int trial = 0; trial < 30; ++trial) {
            const double part = draw.between_ends(0, 1);
            std::vector<R> numbers;
            bool are_within = true;  // numbers that are rounded to floats may not be
            for (const LineBounds& each : bounds) {
                const double low = std::lerp(each.low[0], each.low[1], part);
                const double high = std::lerp(each.high[0], each.high[1], part);
                numbers.push_back(static_cast<R>(draw.between_ends(low, high)));
                are_within &= numbers.back() >= low && numbers.back() <= high;
            }
            ASSERT_FALSE(are_within && holds(condition, numbers)) << seed << ' ' << trial;
        }
    }
    EXPECT_GT(refuted, count / 4);
    EXPECT_GT(only_by_contradiction, count / 200);
}

TEST(Refutation, HoldsWhereverItIsTried) {
    try_conditions<double>(15'000);
    try_conditions<float>(5'000);
}

}  // namespace
}  // namespace rddlc::passes
