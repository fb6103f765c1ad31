#include "passes/arithmetic/compare_magnitudes.hpp"

#include "ir/rewrite.hpp"

#include <cstddef>
#include <optional>
#include <utility>

namespace rddlc::passes {
namespace {

// How many operands further to the left the other bound may stand.
constexpr int reach = 8;

// value op limit, of reals.
struct Bound {
    ir::NodeId value;
    Operator op;
    double limit;
};

std::optional<Bound> bound(const ir::Program& program, ir::NodeId id) {
    const auto* apply = std::get_if<ir::Apply>(&program[id].form);
    if (!apply || !is_order(apply->op)) return std::nullopt;
    const ir::NodeId a = apply->operands[0], b = apply->operands[1];
    if (const auto limit = ir::constant<double>(program, b)) return Bound{a, apply->op, *limit};
    if (const auto limit = ir::constant<double>(program, a))
        return Bound{b, mirrored(apply->op), *limit};
    return std::nullopt;
}

// Both hold within the bounds; one of them holds beyond.
bool is_upper(Operator op, Operator comparison) {
    return op == Operator::And
               ? comparison == Operator::Less || comparison == Operator::LessEqual
               : comparison == Operator::Greater || comparison == Operator::GreaterEqual;
}

class Joining {
  public:
    Joining(ir::Builder& builder, Operator op) : builder_(builder), op_(op) {}

    // `chain op last`, where `last` and an operand of the chain bound the same.
    std::optional<ir::NodeId> joined(ir::NodeId chain, ir::NodeId last, int left = reach) {
        if (const auto both = magnitude(chain, last)) return both;
        const auto* apply = std::get_if<ir::Apply>(&builder_.program()[chain].form);
        if (!apply || apply->op != op_ || left == 0) return std::nullopt;
        const ir::NodeId a = apply->operands[0], b = apply->operands[1];
        if (const auto both = magnitude(b, last)) return builder_.apply(op_, {a, *both});
        const auto rest = joined(a, last, left - 1);
        return rest ? std::optional(builder_.apply(op_, {*rest, b})) : std::nullopt;
    }

  private:
    std::optional<ir::NodeId> magnitude(ir::NodeId a, ir::NodeId b) {
        const auto first = bound(builder_.program(), a), second = bound(builder_.program(), b);
        const bool are_opposite = first && second && first->value == second->value &&
                                  first->op == mirrored(second->op) &&
                                  first->limit == -second->limit;
        if (!are_opposite || !ir::is_droppable(builder_.properties(a))) return std::nullopt;
        const Bound& upper = is_upper(op_, first->op) ? *first : *second;
        if (!is_upper(op_, upper.op) || upper.limit < 0) return std::nullopt;
        const ir::NodeId absolute = builder_.apply(Operator::Abs, {upper.value});
        return builder_.apply(upper.op, {absolute, builder_.constant(upper.limit)});
    }

    ir::Builder& builder_;
    Operator op_;
};

bool is_plain(const ir::Builder& builder, const ir::Computation& condition) {
    return condition.body.empty() && ir::is_droppable(builder.properties(condition.value));
}

// Opposite bounds of two invariants become one of the first of them. No invariant from the first to
// the second may fault, since those behind one that does not hold are not evaluated.
ir::Program joined_invariants(ir::Program program, Report& report) {
    ir::Builder builder(program);
    Joining joining(builder, Operator::And);
    auto& invariants = program.invariants;
    for (std::size_t first = 0; first < invariants.size(); ++first) {
        for (std::size_t other = first; other < invariants.size(); ++other) {
            if (!is_plain(builder, invariants[other])) break;
            if (other == first) continue;
            const auto both = joining.joined(invariants[first].value, invariants[other].value);
            if (!both) continue;
            invariants[first].value = *both;
            invariants[other].value = builder.constant(true);
            ++report["pairs of bounds joined"];
        }
    }
    return ir::collect_garbage(std::move(program));
}

}  // namespace

ir::Program compare_magnitudes(ir::Program program, Report& report) {
    program = ir::rewrite(
        std::move(program),
        [&](ir::Builder& builder, ir::NodeId, const ir::Node& node) -> std::optional<ir::NodeId> {
            const auto* apply = std::get_if<ir::Apply>(&node.form);
            if (!apply || (apply->op != Operator::And && apply->op != Operator::Or))
                return std::nullopt;
            const ir::NodeId a = apply->operands[0], b = apply->operands[1];
            const auto joined = Joining(builder, apply->op).joined(a, b);
            if (joined) ++report["pairs of bounds joined"];
            return joined;
        });
    return joined_invariants(std::move(program), report);
}

}  // namespace rddlc::passes
