#include "passes/arithmetic/compare_roots.hpp"

#include "ir/rewrite.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rddlc::passes {
namespace {

// Squares of greater and smaller limits could leave the range of normal numbers.
constexpr double greatest_limit = 1e12, least_limit = 1e-12;

// The greatest number whose root is at most the limit, or the least one whose root reaches it.
template <class R>
R limit_of_square(R limit, bool is_least) {
    constexpr R infinity = std::numeric_limits<R>::infinity();
    R square = limit * limit;
    while (std::sqrt(square) > limit) square = std::nextafter(square, R{0});
    while (std::sqrt(std::nextafter(square, infinity)) <= limit)
        square = std::nextafter(square, infinity);
    if (!is_least) return square;
    while (std::sqrt(std::nextafter(square, R{0})) >= limit) square = std::nextafter(square, R{0});
    return std::sqrt(square) >= limit ? square : std::nextafter(square, infinity);
}

class RootComparison {
  public:
    RootComparison(ir::Builder& builder, Operator op) : builder_(builder), op_(op) {}

    // `root op limit`, without the root.
    std::optional<ir::NodeId> without_root(ir::NodeId root, ir::NodeId limit) {
        const auto* apply = std::get_if<ir::Apply>(&program()[root].form);
        if (!apply || apply->op != Operator::Sqrt) return std::nullopt;
        const ir::NodeId operand = apply->operands.front();
        if (!is_never_negative(operand)) return std::nullopt;
        const auto square = square_of(limit);
        return square ? std::optional(builder_.apply(op_, {operand, *square})) : std::nullopt;
    }

  private:
    // Whether it is nan, at least 0, or -0.
    bool is_never_negative(ir::NodeId id) const {
        const ir::Node& node = program()[id];
        if (const auto value = ir::constant<double>(program(), id)) return *value >= 0;
        if (const auto* reduce = std::get_if<ir::Reduce>(&node.form))
            return reduce->op == Reduction::Sum && node.type == ir::Scalar::Real &&
                   is_never_negative(reduce->body);
        if (const auto* select = std::get_if<ir::Select>(&node.form))
            return (is_never_negative(select->then_value) ||
                    is_zero_where(select->condition, select->then_value)) &&
                   is_never_negative(select->else_value);
        const auto* apply = std::get_if<ir::Apply>(&node.form);
        if (!apply || node.type != ir::Scalar::Real) return false;
        const ir::NodeId a = apply->operands.front(), b = apply->operands.back();
        if (apply->op == Operator::Power) return ir::constant<double>(program(), b) == 2.0;
        if (apply->op == Operator::Multiply && a == b) return true;
        const bool keeps_sign = apply->op == Operator::Add || apply->op == Operator::Multiply;
        return apply->op == Operator::Abs ||
               (keeps_sign && is_never_negative(a) && is_never_negative(b));
    }

    // Whether the condition is `value == 0`.
    bool is_zero_where(ir::NodeId condition, ir::NodeId value) const {
        const auto* apply = std::get_if<ir::Apply>(&program()[condition].form);
        return apply && apply->op == Operator::Equal && apply->operands.front() == value &&
               ir::constant<double>(program(), apply->operands.back()) == 0.0;
    }

    std::optional<ir::NodeId> square_of(ir::NodeId limit) {
        if (const auto value = ir::constant<double>(program(), limit))
            return is_suitable(*value) ? std::optional(builder_.constant(square(*value)))
                                       : std::nullopt;
        const auto* load = std::get_if<ir::Load>(&program()[limit].form);
        if (!load || program()[load->buffer].storage != ir::Storage::Constant) return std::nullopt;
        const std::vector<ir::NodeId> indices = load->indices;
        const auto table = squares_of(program()[load->buffer]);
        return table ? std::optional(builder_.load(*table, indices)) : std::nullopt;
    }

    std::optional<ir::BufferId> squares_of(const ir::Buffer& limits) {
        ir::Buffer squares = limits;
        squares.name += compares_with_least() ? "-squares" : "-most-squares";
        std::vector<ir::Value> values;
        for (std::int64_t i = 0; i < limits.count(); ++i) {
            const double value = std::get<double>(limits.values[static_cast<std::size_t>(i)]);
            if (!is_suitable(value)) return std::nullopt;
            values.emplace_back(square(value));
        }
        squares.values = std::move(values);
        return builder_.tables().constant(std::move(squares));
    }

    static bool is_suitable(double limit) {
        return limit >= least_limit && limit <= greatest_limit;
    }

    // The comparison changes at the least number whose root reaches the limit.
    bool compares_with_least() const {
        return op_ == Operator::Less || op_ == Operator::GreaterEqual;
    }

    double square(double limit) const {
        if (program().real == RealType::Float)
            return double{limit_of_square(static_cast<float>(limit), compares_with_least())};
        return limit_of_square(limit, compares_with_least());
    }

    const ir::Program& program() const { return builder_.program(); }

    ir::Builder& builder_;
    Operator op_;
};

}  // namespace

ir::Program compare_roots(ir::Program program, Report& report) {
    return ir::rewrite(
        std::move(program),
        [&](ir::Builder& builder, ir::NodeId, const ir::Node& node) -> std::optional<ir::NodeId> {
            const auto* apply = std::get_if<ir::Apply>(&node.form);
            if (!apply || !is_order(apply->op)) return std::nullopt;
            const ir::NodeId a = apply->operands[0], b = apply->operands[1];
            const Operator op = apply->op;
            auto compared = RootComparison(builder, op).without_root(a, b);
            if (!compared) compared = RootComparison(builder, mirrored(op)).without_root(b, a);
            if (compared) ++report["roots that are only compared"];
            return compared;
        });
}

}  // namespace rddlc::passes
