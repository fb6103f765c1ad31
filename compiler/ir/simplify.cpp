#include "ir/simplify.hpp"

#include "ir/fold.hpp"
#include "ir/rewrite.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace rddlc::ir {
namespace {

bool has_value(const Program& program, NodeId id, const Value& expected) {
    const auto* constant = std::get_if<Constant>(&program[id].form);
    return constant && identical(constant->value, expected);
}

// The same result for zeros of both signs.
bool is_blind_to_signs_of_zero(Operator op) {
    return is_comparison(op) ||
           is_one_of(op, {Operator::Abs, Operator::Sign, Operator::Round, Operator::Floor,
                          Operator::Ceil, Operator::Exp, Operator::Cos, Operator::Cosh});
}

class Simplifier {
  public:
    Simplifier(Builder& builder, Operator op, std::span<const NodeId> operands)
        : builder_(builder), op_(op), a_(operands.front()), b_(operands.back()) {}

    std::optional<NodeId> simplify() {
        struct Rule {
            Operator op;
            std::optional<NodeId> (Simplifier::*simplify)();
        };
        constexpr Rule rules[] = {
            {Operator::Add, &Simplifier::add},
            {Operator::Subtract, &Simplifier::subtract},
            {Operator::Multiply, &Simplifier::multiply},
            {Operator::Divide, &Simplifier::divide},
            {Operator::Negate, &Simplifier::negate},
            {Operator::And, &Simplifier::both},
            {Operator::Or, &Simplifier::either},
            {Operator::Not, &Simplifier::negation},
            {Operator::Implies, &Simplifier::implication},
            {Operator::Equal, &Simplifier::equality},
            {Operator::Equivalent, &Simplifier::equality},
            {Operator::NotEqual, &Simplifier::inequality},
            {Operator::Less, &Simplifier::order},
            {Operator::LessEqual, &Simplifier::order},
            {Operator::Greater, &Simplifier::order},
            {Operator::GreaterEqual, &Simplifier::order},
            {Operator::Minimum, &Simplifier::extremum},
            {Operator::Maximum, &Simplifier::extremum},
            {Operator::BitAnd, &Simplifier::common_bits},
            {Operator::BitOr, &Simplifier::united_bits},
            {Operator::BitXor, &Simplifier::united_bits},
        };
        const auto* rule = std::ranges::find(rules, op_, &Rule::op);
        return rule == std::end(rules) ? std::nullopt : (this->*rule->simplify)();
    }

  private:
    // Zeros of reals have a sign: -0.0 + 0.0 is 0.0.
    std::optional<NodeId> add() {
        if (is_neutral_to(b_, a_)) return b_;
        if (is_neutral_to(a_, b_)) return a_;
        const NodeId a = without_zero(a_), b = without_zero(b_);
        if (a == a_ && b == b_) return std::nullopt;
        return plus_zero(builder_.apply(Operator::Add, {a, b}));
    }
    NodeId without_zero(NodeId id) const { return ir::without_zero(builder_.program(), id); }
    NodeId plus_zero(NodeId id) {
        return builder_.apply(Operator::Add, {builder_.constant(0.0), id});
    }
    bool is_neutral_to(NodeId other, NodeId zero) const {
        return is(zero, std::int64_t{0}) || is(zero, -0.0) ||
               (is(zero, 0.0) && builder_.properties(other).never_negative_zero);
    }

    // (x + 3) - 1 = x + 2 for ints, which wrap around.
    std::optional<NodeId> subtract() {
        if (is_zero(b_)) return a_;
        if (const NodeId a = without_zero(a_); a != a_)
            return plus_zero(builder_.apply(Operator::Subtract, {a, b_}));
        if (const NodeId b = without_zero(b_);
            b != b_ && builder_.properties(a_).never_negative_zero)
            return builder_.apply(Operator::Subtract, {a_, b});
        const auto* sum = std::get_if<Apply>(&node(a_).form);
        if (!sum || sum->op != Operator::Add || !int_constant(b_)) return std::nullopt;
        const NodeId first = sum->operands[0], last = sum->operands[1];
        const NodeId known = int_constant(first) ? first : last;
        if (!int_constant(known)) return std::nullopt;
        const NodeId rest = builder_.apply(Operator::Subtract, {known, b_});
        return builder_.apply(Operator::Add, {known == first ? last : first, rest});
    }
    bool int_constant(NodeId id) const {
        return node(id).type == Scalar::Int && std::holds_alternative<Constant>(node(id).form);
    }

    bool is_zero(NodeId id) const { return is(id, std::int64_t{0}) || is(id, 0.0); }
    bool is_one(NodeId id) const { return is(id, std::int64_t{1}) || is(id, 1.0); }

    // The order of ints is known where their ranges do not overlap.
    std::optional<NodeId> order() {
        if (const auto value = compared_bool()) return value;
        const bool is_greater = op_ == Operator::Greater || op_ == Operator::GreaterEqual;
        const bool is_strict = op_ == Operator::Less || op_ == Operator::Greater;
        const NodeId less = is_greater ? b_ : a_, more = is_greater ? a_ : b_;
        if (!are_droppable_ints()) return std::nullopt;
        if (is_strict ? are_less(less, more) : are_at_most(less, more))
            return builder_.constant(true);
        if (is_strict ? are_at_most(more, less) : are_less(more, less))
            return builder_.constant(false);
        return std::nullopt;
    }
    bool are_droppable_ints() const {
        return node(a_).type == Scalar::Int && droppable(a_) && droppable(b_);
    }
    // All values of the first are less than, or at most, all of the second.
    bool are_less(NodeId first, NodeId second) const {
        const auto a = exact_range(first), b = exact_range(second);
        return a && b && a->upper < b->lower;
    }
    bool are_at_most(NodeId first, NodeId second) const {
        const auto a = exact_range(first), b = exact_range(second);
        return a && b && a->upper <= b->lower;
    }
    // Nothing if the bounds of ints may have been rounded.
    std::optional<Range> exact_range(NodeId id) const {
        const auto& range = builder_.properties(id).range;
        const bool is_exact = range && range->lower > -exact_ints && range->upper < exact_ints;
        return is_exact ? range : std::nullopt;
    }

    // Equal operands give the first one: max[0.0, x] is x only if x is greater than 0.
    std::optional<NodeId> extremum() {
        if (a_ == b_) return a_;
        if (are_droppable_ints()) {
            const bool is_minimum = op_ == Operator::Minimum;
            if (are_at_most(a_, b_)) return is_minimum ? a_ : b_;
            if (are_at_most(b_, a_)) return is_minimum ? b_ : a_;
        }
        const NodeId b = without_zero(b_);
        const Properties& first = builder_.properties(a_);
        const bool hides_zeros =
            first.never_negative_zero && first.range &&
            (op_ == Operator::Maximum ? first.range->lower >= 0 : first.range->upper <= 0);
        if (b == b_ || !hides_zeros) return std::nullopt;
        return builder_.apply(op_, {a_, b});
    }

    static constexpr std::int64_t no_bits = 0, all_bits = -1;

    std::optional<NodeId> common_bits() {
        if (is(a_, all_bits) || a_ == b_) return b_;
        if (is(b_, all_bits)) return a_;
        if (is(a_, no_bits) && droppable(b_)) return a_;
        if (is(b_, no_bits) && droppable(a_)) return b_;
        return std::nullopt;
    }
    std::optional<NodeId> united_bits() {
        if (is(a_, no_bits)) return b_;
        if (is(b_, no_bits)) return a_;
        if (a_ == b_ && op_ == Operator::BitOr) return a_;
        return std::nullopt;
    }

    std::optional<NodeId> multiply() {
        if (is_one(a_)) return b_;
        if (is_one(b_)) return a_;
        if (is(a_, std::int64_t{0}) && droppable(b_)) return a_;
        if (is(b_, std::int64_t{0}) && droppable(a_)) return b_;
        return std::nullopt;
    }

    std::optional<NodeId> divide() { return is(b_, 1.0) ? std::optional(a_) : std::nullopt; }
    std::optional<NodeId> negate() { return operand_of(a_, Operator::Negate); }

    std::optional<NodeId> both() {
        if (is(a_, true) || a_ == b_) return b_;
        if (is(b_, true)) return a_;
        if (is(a_, false) && !may_fault(b_)) return a_;  // a draw of b_ is not needed
        if (is(b_, false) && droppable(a_)) return b_;
        if (may_fault(b_)) return builder_.select(a_, b_, builder_.constant(false));
        return absorption(Operator::Or);
    }

    std::optional<NodeId> either() {
        if (is(a_, false) || a_ == b_) return b_;
        if (is(b_, false)) return a_;
        if (is(a_, true) && !may_fault(b_)) return a_;
        if (is(b_, true) && droppable(a_)) return b_;
        if (may_fault(b_)) return builder_.select(a_, builder_.constant(true), b_);
        return absorption(Operator::And);
    }

    // x || (x && y) is x, and so is x && (x || y): `dual` is the operator inside. The parts of a
    // chain may come in any order. Long chains are not looked through.
    std::optional<NodeId> absorption(Operator dual) {
        const auto first = few_parts(a_, op_), last = few_parts(b_, op_);
        if (!first || !last) return std::nullopt;
        const auto kept_last = not_absorbed(*last, *first, dual);
        if (kept_last.empty()) return a_;
        auto kept = not_absorbed(*first, kept_last, dual);
        if (kept.size() + kept_last.size() == first->size() + last->size()) return std::nullopt;
        std::ranges::copy(kept_last, std::back_inserter(kept));
        return joined(builder_, op_, kept);
    }
    // The parts that none of the others decides.
    std::vector<NodeId> not_absorbed(const std::vector<NodeId>& parts,
                                     const std::vector<NodeId>& others, Operator dual) const {
        std::vector<NodeId> kept;
        std::ranges::copy_if(parts, std::back_inserter(kept), [&](NodeId part) {
            return !droppable(part) || std::ranges::none_of(others, [&](NodeId other) {
                return has_parts_of(part, other, dual);
            });
        });
        return kept;
    }
    bool has_parts_of(NodeId whole, NodeId other, Operator op) const {
        const auto all = few_parts(whole, op), some = few_parts(other, op);
        return all && some && std::ranges::all_of(*some, [&](NodeId part) {
                   return std::ranges::find(*all, part) != all->end();
               });
    }
    // The operands of a chain of one operator, from left to right; nothing of a long chain.
    std::optional<std::vector<NodeId>> few_parts(NodeId id, Operator op) const {
        constexpr std::size_t most = 12;
        std::vector<NodeId> parts, left{id};
        while (!left.empty()) {
            const NodeId next = left.back();
            left.pop_back();
            const auto* apply = std::get_if<Apply>(&node(next).form);
            if (!apply || apply->op != op)
                parts.push_back(next);
            else
                left.insert(left.end(), apply->operands.rbegin(), apply->operands.rend());
            if (parts.size() + left.size() > most) return std::nullopt;
        }
        return parts;
    }

    std::optional<NodeId> implication() {
        return builder_.apply(Operator::Or, {builder_.apply(Operator::Not, {a_}), b_});
    }

    std::optional<NodeId> negation() {
        if (const auto inner = operand_of(a_, Operator::Not)) return inner;
        const auto* apply = std::get_if<Apply>(&node(a_).form);
        if (!apply) return std::nullopt;
        const bool reals = node(apply->operands.front()).type == Scalar::Real;
        const auto opposite = opposite_of(apply->op, reals);
        if (!opposite) return std::nullopt;
        return builder_.apply(*opposite, std::vector(apply->operands));
    }

    // nan compares false with everything, so orders of reals have no opposite.
    static std::optional<Operator> opposite_of(Operator op, bool reals) {
        if (op == Operator::Equal) return Operator::NotEqual;
        if (op == Operator::NotEqual) return Operator::Equal;
        if (reals) return std::nullopt;
        if (op == Operator::Less) return Operator::GreaterEqual;
        if (op == Operator::LessEqual) return Operator::Greater;
        if (op == Operator::Greater) return Operator::LessEqual;
        if (op == Operator::GreaterEqual) return Operator::Less;
        return std::nullopt;
    }

    // sign[x] == 0 where x == 0, and nan is neither.
    std::optional<NodeId> sign_against_zero() {
        const auto number = operand_of(a_, Operator::Sign);
        if (!number || !is(b_, std::int64_t{0})) return std::nullopt;
        return builder_.apply(op_, {*number, zero_of(*number)});
    }
    NodeId zero_of(NodeId number) { return builder_.constant(convert(false, node(number).type)); }
    // Signs are equal where both numbers are positive, negative and zero, or neither is: so is that
    // of nan.
    std::optional<NodeId> same_signs() {
        const auto first = operand_of(a_, Operator::Sign), second = operand_of(b_, Operator::Sign);
        if (!first || !second || !droppable(a_) || !droppable(b_)) return std::nullopt;
        const auto agree = [&](Operator order) {
            return builder_.apply(Operator::Equal,
                                  {builder_.apply(order, {*first, zero_of(*first)}),
                                   builder_.apply(order, {*second, zero_of(*second)})});
        };
        return builder_.apply(
            Operator::And,
            {builder_.apply(Operator::And, {agree(Operator::Greater), agree(Operator::Less)}),
             agree(Operator::Equal)});
    }

    // int(b) < 1 where b is false: a comparison with a constant that tells 0 from 1.
    std::optional<NodeId> compared_bool() {
        const auto condition = converted_bool(builder_.program(), a_);
        const auto* constant = std::get_if<Constant>(&node(b_).form);
        if (!condition || !constant) return std::nullopt;
        const Value limit = as_in_a_step(constant->value, builder_.program().real);
        // Without nodes, which would be left in the program where nothing is simplified.
        const auto result_for = [&](bool value) {
            return fold(op_, std::vector{convert(value, node(a_).type), limit});
        };
        const auto if_true = result_for(true), if_false = result_for(false);
        if (!if_true || !if_false || *if_true == *if_false) return std::nullopt;
        return *if_true == Value(true) ? *condition : builder_.apply(Operator::Not, {*condition});
    }

    std::optional<NodeId> equality() {
        if (const auto order = sign_against_zero()) return order;
        if (const auto value = compared_bool()) return value;
        if (const auto same = same_signs()) return same;
        if (is(a_, true)) return b_;
        if (is(b_, true)) return a_;
        if (is(a_, false)) return builder_.apply(Operator::Not, {b_});
        if (is(b_, false)) return builder_.apply(Operator::Not, {a_});
        if (same_discrete()) return builder_.constant(true);
        return std::nullopt;
    }

    std::optional<NodeId> inequality() {
        if (const auto order = sign_against_zero()) return order;
        if (const auto same = same_signs()) return builder_.apply(Operator::Not, {*same});
        if (const auto value = compared_bool()) return value;
        if (is(a_, false)) return b_;
        if (is(b_, false)) return a_;
        if (is(a_, true)) return builder_.apply(Operator::Not, {b_});
        if (is(b_, true)) return builder_.apply(Operator::Not, {a_});
        if (same_discrete()) return builder_.constant(false);
        return std::nullopt;
    }

    // nan differs from itself.
    bool same_discrete() const {
        return a_ == b_ && node(a_).type != Scalar::Real && droppable(a_);
    }

    std::optional<NodeId> operand_of(NodeId id, Operator op) const {
        const auto* apply = std::get_if<Apply>(&node(id).form);
        if (!apply || apply->op != op) return std::nullopt;
        return apply->operands.front();
    }

    bool is(NodeId id, const Value& expected) const {
        return has_value(builder_.program(), id, expected);
    }

    const Node& node(NodeId id) const { return builder_.program()[id]; }
    bool may_fault(NodeId id) const { return builder_.properties(id).may_fault; }
    bool droppable(NodeId id) const { return is_droppable(builder_.properties(id)); }

    Builder& builder_;
    Operator op_;
    NodeId a_;  // by value: building nodes moves the pool
    NodeId b_;
};

std::optional<bool> known_bool(const Program& program, NodeId id) {
    const auto* constant = std::get_if<Constant>(&program[id].form);
    const bool* value = constant ? std::get_if<bool>(&constant->value) : nullptr;
    return value ? std::optional(*value) : std::nullopt;
}

}  // namespace

NodeId without_zero(const Program& program, NodeId id) {
    const auto* sum = std::get_if<Apply>(&program[id].form);
    if (!sum || sum->op != Operator::Add) return id;
    if (has_value(program, sum->operands[0], 0.0)) return sum->operands[1];
    return has_value(program, sum->operands[1], 0.0) ? sum->operands[0] : id;
}

std::optional<NodeId> simplify(Builder& builder, Operator op, std::span<const NodeId> operands) {
    if (is_blind_to_signs_of_zero(op)) {
        std::vector<NodeId> bare(operands.begin(), operands.end());
        for (NodeId& operand : bare) operand = without_zero(builder.program(), operand);
        if (!std::ranges::equal(bare, operands)) return builder.apply(op, std::move(bare));
    }
    return Simplifier(builder, op, operands).simplify();
}

std::optional<NodeId> simplify_select(Builder& builder, NodeId condition, NodeId then_value,
                                      NodeId else_value) {
    const Program& program = builder.program();
    if (const auto known = known_bool(program, condition)) return *known ? then_value : else_value;
    if (then_value == else_value && is_droppable(builder.properties(condition))) return then_value;

    const auto a = known_bool(program, then_value);
    const auto b = known_bool(program, else_value);
    if (a && b && *a && !*b) return condition;
    if (a && b && !*a && *b) return builder.apply(Operator::Not, {condition});

    const auto* apply = std::get_if<Apply>(&program[condition].form);
    if (apply && apply->op == Operator::Not) {
        return builder.select(apply->operands.front(), else_value, then_value);
    }
    return std::nullopt;
}

}  // namespace rddlc::ir
