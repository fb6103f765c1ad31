#include "passes/analyses/decisive.hpp"

#include "support/match.hpp"

#include <algorithm>

namespace rddlc::passes {
namespace {

using Conditions = std::vector<Condition>;

// The value as a number.
double number(const ir::Value& value) {
    return match(value, [](auto v) { return static_cast<double>(v); });
}

class Search {
  public:
    explicit Search(const ir::Builder& builder) : builder_(builder) {}

    Conditions of(ir::NodeId id, const ir::Value& value) const {
        const ir::Node& node = program()[id];
        Conditions found = match(
            node.form, [&](const ir::Convert& form) { return of_convert(form, value); },
            [&](const ir::Apply& form) { return of_apply(form, value); },
            [&](const ir::Select& form) { return of_select(form, value); },
            [](const auto&) { return Conditions(); });
        if (const bool* is_true = std::get_if<bool>(&value)) found.push_back({id, !*is_true});
        return found;
    }

  private:
    Conditions of_convert(const ir::Convert& convert, const ir::Value& value) const {
        if (number(value) != 0) return {};
        if (program()[convert.operand].type == ir::Scalar::Bool) return of(convert.operand, false);
        return of(convert.operand, std::int64_t{0});
    }

    Conditions of_apply(const ir::Apply& apply, const ir::Value& value) const {
        const ir::NodeId a = apply.operands.front(), b = apply.operands.back();
        const Operator op = apply.op;
        if (op == Operator::Not) return of(a, !std::get<bool>(value));
        if (is_one_of(op, {Operator::And, Operator::Or}))
            return std::get<bool>(value) == (op == Operator::And)
                       ? common(of(a, value), of(b, value))
                       : all(of(a, value), of(b, value));
        if (std::holds_alternative<bool>(value) || number(value) != 0) return {};
        if (op == Operator::Multiply) return of_product(a, b, value);
        if (op == Operator::Divide)
            return excludes_zero(builder_.properties(b).range) ? of(a, value) : Conditions();
        if (op == Operator::Negate) return of(a, value);
        if (is_one_of(op, {Operator::Add, Operator::Subtract}))
            return common(of(a, value), of(b, value));
        return {};
    }

    // 0 * x is 0 where x is finite.
    Conditions of_product(ir::NodeId a, ir::NodeId b, const ir::Value& zero) const {
        const bool finite_a = builder_.properties(a).finite,
                   finite_b = builder_.properties(b).finite;
        return all(finite_b ? of(a, zero) : Conditions(), finite_a ? of(b, zero) : Conditions());
    }

    // A branch that has the value in any case leaves the other one to decide.
    Conditions of_select(const ir::Select& select, const ir::Value& value) const {
        if (number(value) == 0 && ir::is_guarded_product(program(), select))
            return of(select.else_value, value);
        if (is_constant(select.else_value, value))
            return all(of(select.condition, false), of(select.then_value, value));
        if (is_constant(select.then_value, value))
            return all(of(select.condition, true), of(select.else_value, value));
        return common(of(select.then_value, value), of(select.else_value, value));
    }

    bool is_constant(ir::NodeId id, const ir::Value& value) const {
        const auto* constant = std::get_if<ir::Constant>(&program()[id].form);
        return constant && constant->value == value;
    }

    static Conditions all(Conditions a, const Conditions& b) {
        a.insert(a.end(), b.begin(), b.end());
        return a;
    }

    static Conditions common(Conditions a, const Conditions& b) {
        std::erase_if(a, [&](const Condition& condition) {
            return std::ranges::find(b, condition) == b.end();
        });
        return a;
    }

    const ir::Program& program() const { return builder_.program(); }

    const ir::Builder& builder_;
};

}  // namespace

std::vector<Condition> decisive_conditions(const ir::Builder& builder, ir::NodeId id,
                                           const ir::Value& value) {
    return Search(builder).of(id, value);
}

}  // namespace rddlc::passes
