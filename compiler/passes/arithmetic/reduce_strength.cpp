#include "passes/arithmetic/reduce_strength.hpp"

#include "ir/rewrite.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

namespace rddlc::passes {
namespace {

// An expression of more operations (Properties::cost) is not written twice.
constexpr double cheap_operand = 6;
constexpr std::int64_t largest_int_exponent = 4;

// Whether a product with 1 / value is a quotient by it, to the bit.
template <class Number>
bool is_power_of_two(double value) {
    int exponent = 0;
    const double fraction = std::frexp(std::abs(value), &exponent);
    return fraction == 0.5 && std::isnormal(static_cast<Number>(value)) &&
           std::isnormal(static_cast<Number>(1 / value));
}
bool is_power_of_two(double value, RealType real) {
    return real == RealType::Float ? is_power_of_two<float>(value) : is_power_of_two<double>(value);
}

bool is_zero(const ir::Program& program, ir::NodeId id) {
    const auto value = ir::constant<double>(program, id);
    return value && std::bit_cast<std::uint64_t>(*value) == 0;
}

ir::NodeId product(ir::Builder& builder, ir::NodeId base, std::int64_t count) {
    ir::NodeId result = base;
    for (std::int64_t k = 1; k < count; ++k)
        result = builder.apply(Operator::Multiply, {result, base});
    return result;
}

std::optional<ir::NodeId> reduced_power(ir::Builder& builder, ir::NodeId base,
                                        ir::NodeId exponent) {
    if (builder.properties(base).cost > cheap_operand) return std::nullopt;
    const auto real = ir::constant<double>(builder.program(), exponent);
    if (real && *real == 2) return product(builder, base, 2);
    const auto whole = ir::constant<std::int64_t>(builder.program(), exponent);
    if (whole && *whole >= 1 && *whole <= largest_int_exponent)
        return product(builder, base, *whole);
    return std::nullopt;
}

// The bool that a term makes a number of: real(b), real(!b) and the products of these with
// constants.
std::optional<ir::NodeId> bool_of_term(const ir::Program& program, ir::NodeId id) {
    if (const auto* apply = std::get_if<ir::Apply>(&program[id].form)) {
        if (apply->op != Operator::Multiply) return std::nullopt;
        const ir::NodeId a = apply->operands.front(), b = apply->operands.back();
        if (ir::constant<double>(program, a)) return bool_of_term(program, b);
        return ir::constant<double>(program, b) ? bool_of_term(program, a) : std::nullopt;
    }
    const auto operand = ir::converted_bool(program, id);
    if (!operand) return std::nullopt;
    const auto* apply = std::get_if<ir::Apply>(&program[*operand].form);
    return apply && apply->op == Operator::Not ? apply->operands.front() : operand;
}

// The sum or difference of two terms of one bool.
std::optional<ir::NodeId> one_of_two(ir::Builder& builder, const ir::Apply& apply) {
    const auto condition = bool_of_term(builder.program(), apply.operands.front());
    if (!condition || condition != bool_of_term(builder.program(), apply.operands.back()))
        return std::nullopt;
    const auto value_if = [&](bool value) {
        std::map<ir::NodeId, ir::NodeId> known = {{*condition, builder.constant(value)}};
        const ir::NodeId a = ir::replace_in(builder, apply.operands.front(), known),
                         b = ir::replace_in(builder, apply.operands.back(), known);
        return builder.apply(apply.op, {a, b});
    };
    const ir::NodeId then_value = value_if(true), else_value = value_if(false);
    return builder.select(*condition, then_value, else_value);
}

std::optional<ir::NodeId> reduced(ir::Builder& builder, const ir::Apply& apply) {
    const ir::Program& program = builder.program();
    const ir::NodeId a = apply.operands.front(), b = apply.operands.back();
    if (apply.op == Operator::Power) return reduced_power(builder, a, b);
    if (apply.op == Operator::Divide) {
        const auto divisor = ir::constant<double>(program, b);
        if (!divisor || !is_power_of_two(*divisor, program.real)) return std::nullopt;
        return builder.apply(Operator::Multiply, {a, builder.constant(1 / *divisor)});
    }
    if (apply.op == Operator::Add || apply.op == Operator::Subtract)
        return one_of_two(builder, apply);
    if (apply.op != Operator::Multiply) return std::nullopt;
    const bool vanishes = (is_zero(program, a) && ir::converted_bool(program, b)) ||
                          (is_zero(program, b) && ir::converted_bool(program, a));
    const ir::NodeId other = is_zero(program, a) ? b : a;
    if (!vanishes || !ir::is_droppable(builder.properties(other))) return std::nullopt;
    return builder.constant(0.0);
}

}  // namespace

ir::Program reduce_strength(ir::Program program, Report& report) {
    return ir::rewrite(
        std::move(program),
        [&](ir::Builder& builder, ir::NodeId, const ir::Node& node) -> std::optional<ir::NodeId> {
            const auto* apply = std::get_if<ir::Apply>(&node.form);
            const auto cheaper = apply ? reduced(builder, *apply) : std::nullopt;
            if (cheaper) ++report["operators made cheaper"];
            return cheaper;
        });
}

}  // namespace rddlc::passes
