#include "passes/analyses/int_order.hpp"

#include "ir/analysis.hpp"

#include <limits>
#include <optional>

namespace rddlc::passes {
namespace {

// A comparison holds for the ints of [lower, upper].
struct IntsWhere {
    ir::NodeId value;
    std::int64_t lower = std::numeric_limits<std::int64_t>::min();
    std::int64_t upper = std::numeric_limits<std::int64_t>::max();
};

std::optional<IntsWhere> ints_where(const ir::Program& program, ir::NodeId comparison) {
    const auto* apply = std::get_if<ir::Apply>(&program[comparison].form);
    if (!apply || !is_comparison(apply->op)) return std::nullopt;
    const auto limit = ir::constant<std::int64_t>(program, apply->operands[1]);
    IntsWhere ints{apply->operands[0]};
    if (!limit || *limit == ints.lower || *limit == ints.upper) return std::nullopt;
    if (apply->op == Operator::Less)
        ints.upper = *limit - 1;
    else if (apply->op == Operator::LessEqual)
        ints.upper = *limit;
    else if (apply->op == Operator::Greater)
        ints.lower = *limit + 1;
    else if (apply->op == Operator::GreaterEqual)
        ints.lower = *limit;
    else if (apply->op == Operator::Equal)
        ints.lower = ints.upper = *limit;
    else
        return std::nullopt;
    return ints;
}

}  // namespace

bool implies(const ir::Program& program, ir::NodeId first, ir::NodeId second) {
    const auto a = ints_where(program, first), b = ints_where(program, second);
    return a && b && a->value == b->value && b->lower <= a->lower && a->upper <= b->upper;
}

}  // namespace rddlc::passes
