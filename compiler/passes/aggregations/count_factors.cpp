#include "passes/aggregations/count_factors.hpp"

#include "ir/analysis.hpp"
#include "ir/rewrite.hpp"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// Larger tables of bools are not counted as bits (count_bits.hpp).
constexpr double most_factors = 512;

struct Factor {
    double value;
    ir::NodeId condition;  // where it is not, the factor is 1
};

std::optional<Factor> factor_of(ir::Builder& builder, ir::NodeId body) {
    const auto* select = std::get_if<ir::Select>(&builder.program()[body].form);
    if (!select || !ir::is_droppable(builder.properties(select->condition))) return std::nullopt;
    const ir::NodeId condition = select->condition;
    const auto first = ir::constant<double>(builder.program(), select->then_value);
    const auto second = ir::constant<double>(builder.program(), select->else_value);
    if (!first || !second) return std::nullopt;
    if (*second == 1.0) return Factor{*first, condition};
    if (*first == 1.0) return Factor{*second, builder.apply(Operator::Not, {condition})};
    return std::nullopt;
}

// As a simulator multiplies them. Floats have been rounded before.
template <class Real>
std::vector<ir::Value> powers_of(double factor, std::int64_t most) {
    Real power = 1;
    std::vector<ir::Value> powers{double{power}};
    for (std::int64_t i = 0; i < most; ++i)
        powers.emplace_back(double{power *= static_cast<Real>(factor)});
    return powers;
}

// The first table that the condition reads gives the powers their name.
std::optional<ir::BufferId> first_table(const ir::Program& program, ir::NodeId condition) {
    if (const auto table = ir::buffer_read_by(program[condition])) return table;
    for (const ir::NodeId operand : ir::operands_of(program[condition]))
        if (const auto table = first_table(program, operand)) return table;
    return std::nullopt;
}

std::optional<ir::BufferId> table_of_powers(ir::Builder& builder, const Factor& factor,
                                            std::int64_t most) {
    const ir::Program& program = builder.program();
    const auto counted = first_table(program, factor.condition);
    if (!counted) return std::nullopt;
    ir::Buffer table{.name = program[*counted].name + "-powers",
                     .storage = ir::Storage::Constant,
                     .scalar = ir::Scalar::Real,
                     .shape = {most + 1},
                     .span = program[*counted].span};
    table.values = program.real == RealType::Float ? powers_of<float>(factor.value, most)
                                                   : powers_of<double>(factor.value, most);
    return builder.tables().constant(std::move(table));
}

std::optional<ir::NodeId> looked_up(ir::Builder& builder, const ir::Reduce& product) {
    const auto factor = factor_of(builder, product.body);
    if (!factor) return std::nullopt;
    const ir::NodeId count =
        builder.reduce(Reduction::Sum, product.variable,
                       builder.convert(factor->condition, ir::Scalar::Int), product.bounds);
    const auto range = builder.properties(count).range;
    if (!range || range->lower < 0 || range->upper > most_factors) return std::nullopt;
    const auto most = static_cast<std::int64_t>(range->upper);
    const auto powers = table_of_powers(builder, *factor, most);
    return powers ? std::optional(builder.load(*powers, {count})) : std::nullopt;
}

}  // namespace

ir::Program count_factors(ir::Program program, Report& report) {
    return ir::rewrite(
        std::move(program),
        [&](ir::Builder& builder, ir::NodeId, const ir::Node& node) -> std::optional<ir::NodeId> {
            const auto* reduce = std::get_if<ir::Reduce>(&node.form);
            if (!reduce || reduce->op != Reduction::Product || node.type != ir::Scalar::Real)
                return std::nullopt;
            const auto power = looked_up(builder, *reduce);
            if (power) ++report["products of one factor"];
            return power;
        });
}

}  // namespace rddlc::passes
