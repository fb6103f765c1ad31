#include "passes/count_bools.hpp"

#include "ir/rewrite.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// A constant times a bool or an int.
struct Term {
    double coefficient;
    ir::NodeId counted;
};
using Terms = std::vector<Term>;

// Appends the terms whose sum, times the coefficient, the expression is; false if it is none.
bool split(const ir::Program& program, ir::NodeId id, double coefficient, Terms& terms) {
    if (const auto constant = ir::constant<double>(program, id)) return *constant == 0;
    if (const auto* convert = std::get_if<ir::Convert>(&program[id].form)) {
        terms.push_back({coefficient, convert->operand});
        return true;
    }
    const auto* apply = std::get_if<ir::Apply>(&program[id].form);
    if (!apply) return false;
    const auto operand = [&](std::size_t k, double factor) {
        return split(program, apply->operands[k], factor, terms);
    };
    switch (apply->op) {
        case Operator::Add:
            return operand(0, coefficient) && operand(1, coefficient);
        case Operator::Subtract:
            return operand(0, coefficient) && operand(1, -coefficient);
        case Operator::Negate:
            return operand(0, -coefficient);
        case Operator::Multiply:
            for (const std::size_t k : {0, 1}) {
                const auto factor = ir::constant<double>(program, apply->operands[k]);
                if (factor) return operand(1 - k, coefficient * *factor);
            }
            return false;
        default:
            return false;
    }
}

class Counting {
  public:
    Counting(ir::Builder& builder, const ir::Reduce& sum) : builder_(builder), sum_(sum) {}

    std::optional<ir::NodeId> counted() {
        const bool is_random = builder_.facts(sum_.body).random;
        if (is_random || builder_.facts(sum_.body).may_fault) return std::nullopt;
        Terms terms;
        if (!split(builder_.program(), sum_.body, 1, terms) || terms.empty()) return std::nullopt;
        if (!are_exact(terms)) return std::nullopt;

        std::optional<ir::NodeId> total;
        for (const Term& term : terms)
            if (term.coefficient > 0) total = joined(Operator::Add, total, term);
        for (const Term& term : terms)
            if (term.coefficient < 0) total = joined(Operator::Subtract, total, term);
        return total ? *total : zero();
    }

  private:
    // A term that is never negative zero; so neither is their sum.
    ir::NodeId joined(Operator op, std::optional<ir::NodeId> total, const Term& term) {
        const ir::NodeId count = builder_.convert(
            builder_.reduce(Reduction::Sum, sum_.variable,
                            builder_.convert(term.counted, ir::Scalar::Int), sum_.bounds),
            ir::Scalar::Real);
        const double size = std::abs(term.coefficient);
        const ir::NodeId value =
            size == 1 ? count
                      : builder_.apply(Operator::Multiply, {builder_.constant(size), count});
        if (!total && op == Operator::Add) return value;
        return builder_.apply(op, {total ? *total : zero(), value});
    }

    // Every sum of them is a multiple of `unit` that 53 bits hold, so none is rounded.
    bool are_exact(const Terms& terms) const {
        constexpr double unit = 0x1p-20, largest = 0x1p53 * unit;
        double most = 0;
        for (const Term& term : terms) {
            const auto value = greatest(term.counted);
            if (!value || std::fmod(term.coefficient, unit) != 0) return false;
            most += std::abs(term.coefficient) * *value;
        }
        return most * static_cast<double>(builder_.program()[sum_.variable].size) < largest;
    }

    // Of a bool, or of an int that is never negative.
    std::optional<double> greatest(ir::NodeId id) const {
        if (builder_.program()[id].type == ir::Scalar::Bool) return 1;
        const auto& range = builder_.facts(id).range;
        if (!range || range->lower < 0) return std::nullopt;
        return range->upper;
    }

    ir::NodeId zero() { return builder_.constant(0.0); }

    ir::Builder& builder_;
    const ir::Reduce& sum_;
};

}  // namespace

ir::Program count_bools(ir::Program program, Report& report) {
    return ir::rewrite(
        std::move(program),
        [&](ir::Builder& builder, ir::NodeId, const ir::Node& node) -> std::optional<ir::NodeId> {
            const auto* reduce = std::get_if<ir::Reduce>(&node.form);
            const bool is_sum = reduce && reduce->op == Reduction::Sum;
            if (!is_sum || node.type != ir::Scalar::Real) return std::nullopt;
            const auto counted = Counting(builder, *reduce).counted();
            if (counted) ++report["sums that count in ints"];
            return counted;
        });
}

}  // namespace rddlc::passes
