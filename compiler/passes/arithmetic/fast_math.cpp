#include "passes/arithmetic/fast_math.hpp"

#include "ir/rewrite.hpp"

#include <cmath>
#include <utility>

namespace rddlc::passes {
namespace {

// An expression of more operations (Properties::cost) is not written twice.
constexpr double cheap_to_write_twice = 6;

class Relaxing {
  public:
    explicit Relaxing(ir::Builder& builder) : builder_(builder) {}

    std::optional<ir::NodeId> relaxed(const ir::Node& node) {
        if (node.type != ir::Scalar::Real) return std::nullopt;
        if (const auto* select = std::get_if<ir::Select>(&node.form)) return product(*select);
        const auto* apply = std::get_if<ir::Apply>(&node.form);
        if (!apply) return std::nullopt;
        const ir::NodeId a = apply->operands.front(), b = apply->operands.back();
        const Operator op = apply->op;
        if (op == Operator::Multiply) return product(a, b);
        if (op == Operator::Add) return sum(a, b);
        if (op == Operator::Subtract) return difference(a, b);
        if (op == Operator::Divide) return quotient(a, b);
        if (op == Operator::Power) return power(a, b);
        if (op == Operator::FloorModuloReal) return remainder(a, b);
        if (is_one_of(op, {Operator::Minimum, Operator::Maximum})) return constant_last(op, a, b);
        return std::nullopt;
    }

  private:
    std::optional<ir::NodeId> sum(ir::NodeId a, ir::NodeId b) {
        if (const auto first = constant(a)) return shifted(b, *first);
        if (const auto second = constant(b)) return shifted(a, *second);
        return std::nullopt;
    }
    std::optional<ir::NodeId> difference(ir::NodeId a, ir::NodeId b) {
        if (const auto second = constant(b)) return shifted(a, -*second);
        return constant(a) == 0.0 ? scaled(b, -1.0) : std::nullopt;
    }

    // x + shift, where that takes no more operations than x does: x is a sum with a constant term.
    // Sought in `depth` operations inside each other.
    std::optional<ir::NodeId> shifted(ir::NodeId x, double shift, int depth = 5) {
        if (shift == 0) return x;
        if (const auto value = constant(x)) return builder_.constant(*value + shift);
        const auto* apply = std::get_if<ir::Apply>(&builder_.program()[x].form);
        const bool is_sum =
            apply && (apply->op == Operator::Add || apply->op == Operator::Subtract);
        if (!is_sum || depth == 0) return std::nullopt;
        const Operator op = apply->op;
        const ir::NodeId a = apply->operands[0], b = apply->operands[1];
        const double shift_of_b = op == Operator::Add ? shift : -shift;
        if (const auto second = shifted(b, shift_of_b, depth - 1))
            return constant(*second) == 0.0 ? a : builder_.apply(op, {a, *second});
        if (const auto first = shifted(a, shift, depth - 1))
            return constant(*first) == 0.0 && op == Operator::Add ? b
                                                                  : builder_.apply(op, {*first, b});
        return std::nullopt;
    }

    std::optional<ir::NodeId> product(ir::NodeId a, ir::NodeId b) {
        const auto first = constant(a), second = constant(b);
        if (!first && !second) return std::nullopt;
        if (first && second) return std::nullopt;  // the builder has folded it
        return scaled(first ? b : a, first ? *first : *second);
    }

    std::optional<ir::NodeId> quotient(ir::NodeId a, ir::NodeId b) {
        if (!constant(b)) return product_with_inverse(a, b);
        const auto inverse = constant_inverse(b);
        if (!inverse) return std::nullopt;
        if (const auto simpler = scaled(a, *inverse)) return simpler;
        return multiply(a, builder_.constant(*inverse));
    }
    std::optional<double> constant_inverse(ir::NodeId id) const {
        const auto value = constant(id);
        if (!value || !std::isnormal(*value) || !std::isnormal(1 / *value)) return std::nullopt;
        return 1 / *value;
    }

    std::optional<ir::NodeId> remainder(ir::NodeId a, ir::NodeId b) {
        const auto inverse = constant_inverse(b);
        if (!inverse) return std::nullopt;
        const ir::NodeId quotient = multiply(a, builder_.constant(*inverse));
        const ir::NodeId whole =
            builder_.convert(builder_.apply(Operator::Floor, {quotient}), ir::Scalar::Real);
        return builder_.apply(Operator::Subtract, {a, multiply(b, whole)});
    }

    // Where only loop variables change the divisor, tabulate_constants makes its inverses a table.
    std::optional<ir::NodeId> product_with_inverse(ir::NodeId a, ir::NodeId b) {
        const ir::Properties& divisor = builder_.properties(b);
        const bool is_table = divisor.uniform && !divisor.free_variables.empty();
        if (!is_table || !ir::is_droppable(divisor) || builder_.properties(a).uniform)
            return std::nullopt;
        const auto [factor, rest] = without_constant_factor(a);
        return multiply(rest, builder_.apply(Operator::Divide, {builder_.constant(factor), b}));
    }

    // One instruction does not tell which zero, or which nan, it takes.
    std::optional<ir::NodeId> constant_last(Operator op, ir::NodeId a, ir::NodeId b) {
        if (constant(a) != 0.0 || constant(b)) return std::nullopt;
        return builder_.apply(op, {b, a});
    }

    // x * factor, where that takes no more operations than x does: x or one of its factors is
    // constant, or so are those of both of its terms. Sought in `depth` operations inside each
    // other.
    std::optional<ir::NodeId> scaled(ir::NodeId x, double factor, int depth = 5) {
        if (factor == 0 && ir::is_droppable(builder_.properties(x))) return builder_.constant(0.0);
        if (const auto value = constant(x)) return builder_.constant(*value * factor);
        const auto* apply = std::get_if<ir::Apply>(&builder_.program()[x].form);
        if (!apply || depth == 0) return std::nullopt;
        const Operator op = apply->op;
        const ir::NodeId a = apply->operands.front(), b = apply->operands.back();
        if (op == Operator::Multiply) {
            if (const auto second = scaled(b, factor, depth - 1)) return multiply(a, *second);
            if (const auto first = scaled(a, factor, depth - 1)) return multiply(*first, b);
        }
        if (op == Operator::Add || op == Operator::Subtract) {
            const auto first = scaled(a, factor, depth - 1), second = scaled(b, factor, depth - 1);
            if (first && second) return builder_.apply(op, {*first, *second});
        }
        return std::nullopt;
    }

    // factor * rest; the factor may be 1.
    struct Scaled {
        double factor;
        ir::NodeId rest;
    };
    Scaled without_constant_factor(ir::NodeId x) const {
        const auto* apply = std::get_if<ir::Apply>(&builder_.program()[x].form);
        if (!apply || apply->op != Operator::Multiply) return {1.0, x};
        const ir::NodeId a = apply->operands[0], b = apply->operands[1];
        if (const auto factor = constant(a)) return {*factor, b};
        if (const auto factor = constant(b)) return {*factor, a};
        return {1.0, x};
    }

    // The test for zero of a product that RDDL makes 0 even if the other factor is inf or nan.
    std::optional<ir::NodeId> product(const ir::Select& select) {
        const ir::Program& program = builder_.program();
        const auto* test = std::get_if<ir::Apply>(&program[select.condition].form);
        const auto* apply = std::get_if<ir::Apply>(&program[select.else_value].form);
        if (!test || test->op != Operator::Equal || !apply || apply->op != Operator::Multiply)
            return std::nullopt;
        const ir::NodeId factor = select.then_value;
        const auto zero = constant(test->operands[1]);
        const bool is_test = test->operands[0] == factor && zero && *zero == 0;
        const bool is_first = apply->operands[0] == factor;
        const ir::NodeId other = apply->operands[is_first ? 1 : 0];
        if (!is_test || (!is_first && apply->operands[1] != factor)) return std::nullopt;
        if (!ir::is_droppable(builder_.properties(other))) return std::nullopt;
        return select.else_value;
    }

    std::optional<ir::NodeId> power(ir::NodeId base, ir::NodeId exponent) {
        const auto value = constant(exponent);
        if (value && *value == 0.5) return builder_.apply(Operator::Sqrt, {base});
        if (!value || *value != 3 || builder_.properties(base).cost > cheap_to_write_twice)
            return std::nullopt;
        return multiply(multiply(base, base), base);
    }

    std::optional<double> constant(ir::NodeId id) const {
        return ir::constant<double>(builder_.program(), id);
    }

    ir::NodeId multiply(ir::NodeId a, ir::NodeId b) {
        return builder_.apply(Operator::Multiply, {a, b});
    }

    ir::Builder& builder_;
};

}  // namespace

ir::Program fast_math(ir::Program program, Report& report) {
    program.assumes_finite = true;
    return ir::rewrite(
        std::move(program),
        [&](ir::Builder& builder, ir::NodeId, const ir::Node& node) -> std::optional<ir::NodeId> {
            const auto simpler = Relaxing(builder).relaxed(node);
            if (simpler) ++report["expressions relaxed"];
            return simpler;
        });
}

}  // namespace rddlc::passes
