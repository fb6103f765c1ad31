#include "passes/aggregations/count_bools.hpp"

#include "ir/rewrite.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// A constant times a bool, or times an int that is never negative.
struct Term {
    double coefficient;
    ir::NodeId counted;
};
using Terms = std::vector<Term>;

// A simulator computes sums and products exactly if all of their parts are multiples of this unit
// that 53 bits hold.
constexpr double unit = 0x1p-20, largest_exact = 0x1p53 * unit;

// Finds the terms whose sum an expression is, if no operation of it is ever rounded.
class Splitting {
  public:
    explicit Splitting(const ir::Builder& builder) : builder_(builder) {}

    std::optional<Terms> terms_of(ir::NodeId id) const {
        auto terms = parts_of(id);
        if (!terms || !(most(*terms) < largest_exact)) return std::nullopt;
        return terms;
    }

    // The greatest magnitude of their sum; nan if a coefficient is not a multiple of the unit.
    double most(const Terms& terms) const {
        double most = 0;
        for (const Term& term : terms) {
            const bool is_multiple = std::fmod(term.coefficient, unit) == 0;
            const auto value = greatest(term.counted);
            if (!is_multiple || !value) return std::numeric_limits<double>::quiet_NaN();
            most += std::abs(term.coefficient) * *value;
        }
        return most;
    }

  private:
    std::optional<Terms> parts_of(ir::NodeId id) const {
        const ir::Program& program = builder_.program();
        if (const auto constant = ir::constant<double>(program, id))
            return *constant == 0 ? std::optional(Terms()) : std::nullopt;
        if (const auto* convert = std::get_if<ir::Convert>(&program[id].form))
            return Terms{{1, convert->operand}};
        const auto* apply = std::get_if<ir::Apply>(&program[id].form);
        if (!apply) return std::nullopt;
        const ir::NodeId a = apply->operands.front(), b = apply->operands.back();
        if (apply->op == Operator::Add) return sum(terms_of(a), terms_of(b));
        if (apply->op == Operator::Subtract) return sum(terms_of(a), scaled(terms_of(b), -1));
        if (apply->op == Operator::Negate) return scaled(terms_of(a), -1);
        if (apply->op != Operator::Multiply) return std::nullopt;
        if (const auto factor = ir::constant<double>(program, a))
            return scaled(terms_of(b), *factor);
        if (const auto factor = ir::constant<double>(program, b))
            return scaled(terms_of(a), *factor);
        return std::nullopt;
    }

    static std::optional<Terms> sum(std::optional<Terms> a, const std::optional<Terms>& b) {
        if (!a || !b) return std::nullopt;
        a->insert(a->end(), b->begin(), b->end());
        return a;
    }

    static std::optional<Terms> scaled(std::optional<Terms> terms, double factor) {
        if (!terms) return std::nullopt;
        for (Term& term : *terms) {
            const double product = term.coefficient * factor;
            const bool is_exact = std::fma(term.coefficient, factor, -product) == 0;
            if (!is_exact) return std::nullopt;
            term.coefficient = product;
        }
        return terms;
    }

    // The operand is a bool, or an int that is never negative.
    std::optional<double> greatest(ir::NodeId id) const {
        if (builder_.program()[id].type == ir::Scalar::Bool) return 1;
        const auto& range = builder_.properties(id).range;
        if (!range || range->lower < 0) return std::nullopt;
        return range->upper;
    }

    const ir::Builder& builder_;
};

class BoolCounting {
  public:
    BoolCounting(ir::Builder& builder, const ir::Reduce& sum) : builder_(builder), sum_(sum) {}

    std::optional<ir::NodeId> counted() {
        const bool is_random = builder_.properties(sum_.body).random;
        if (is_random || builder_.properties(sum_.body).may_fault) return std::nullopt;
        const Splitting splitting(builder_);
        const auto terms = splitting.terms_of(sum_.body);
        if (!terms || terms->empty()) return std::nullopt;
        const auto count = static_cast<double>(builder_.program()[sum_.variable].size);
        if (!(splitting.most(*terms) * count < largest_exact)) return std::nullopt;

        std::optional<ir::NodeId> total;
        for (const Term& term : *terms)
            if (term.coefficient > 0) total = joined(Operator::Add, total, term);
        for (const Term& term : *terms)
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
            const auto counted = BoolCounting(builder, *reduce).counted();
            if (counted) ++report["sums that count in ints"];
            return counted;
        });
}

}  // namespace rddlc::passes
