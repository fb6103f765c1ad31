#include "passes/analyses/object_condition.hpp"

#include "support/match.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace rddlc::passes {
namespace {

using Form = ObjectCondition::Form;
using Term = ObjectCondition::Term;

// Bounds of longer products are too wide to prove anything.
constexpr int most_factors = 8;

struct Making {
    const ir::Program& program;
    ir::VariableId object;
    std::map<ir::LocalId, ir::NodeId> locals = {};
    std::map<ir::NodeId, std::size_t> made = {};
    ObjectCondition condition = {};

    std::optional<std::size_t> term(ir::NodeId id) {
        if (const auto known = made.find(id); known != made.end()) return known->second;
        const ir::Node& node = program[id];
        if (const auto* local = std::get_if<ir::Local>(&node.form)) {
            const auto value = locals.find(local->local);
            return value == locals.end() ? std::nullopt : term(value->second);
        }
        auto made_term = match(
            node.form,
            [&](const ir::Constant& constant) -> std::optional<Term> {
                return constants({&constant.value, 1});
            },
            [&](const ir::Load& load) { return loaded(load); },
            [&](const ir::Apply& apply) { return applied(apply); },
            [&](const ir::Select& select) {
                return with_operands({Form::Select},
                                     {select.condition, select.then_value, select.else_value});
            },
            [](const auto&) -> std::optional<Term> { return std::nullopt; });
        if (!made_term || node.type == ir::Scalar::Int) return std::nullopt;
        made_term->is_bool = node.type == ir::Scalar::Bool;
        condition.terms.push_back(*std::move(made_term));
        return made[id] = condition.terms.size() - 1;
    }

    // A value for each object, or one for all.
    std::optional<Term> constants(std::span<const ir::Value> values) const {
        Term term{Form::Constant};
        for (const ir::Value& value : values) {
            if (const auto* real = std::get_if<double>(&value))
                term.constants.push_back(program.real == RealType::Float ? static_cast<float>(*real)
                                                                         : *real);
            else if (const auto* is = std::get_if<bool>(&value))
                term.constants.push_back(*is ? 1 : 0);
            else
                return std::nullopt;
            if (!std::isfinite(term.constants.back())) return std::nullopt;
        }
        return term;
    }

    std::optional<Term> loaded(const ir::Load& load) {
        const ir::Buffer& buffer = program[load.buffer];
        if (buffer.storage == ir::Storage::Constant) {
            const bool is_of_object =
                load.indices.size() == 1 && program[load.indices.front()].form ==
                                                ir::Node{ir::Scalar::Int, ir::Index{object}}.form;
            if (!is_of_object) return std::nullopt;
            std::vector<ir::Value> values;
            for (std::int64_t i = 0; i < buffer.count(); ++i) values.push_back(buffer.values[i]);
            return constants(values);
        }
        if (!load.indices.empty() || buffer.scalar != ir::Scalar::Real) return std::nullopt;
        auto& numbers = condition.numbers;
        const auto found = std::ranges::find(numbers, load.buffer);
        Term term{Form::Number};
        term.number = static_cast<std::size_t>(found - numbers.begin());
        term.degree = 1;
        if (found == numbers.end()) numbers.push_back(load.buffer);
        return term;
    }

    std::optional<Term> applied(const ir::Apply& apply) {
        constexpr Operator known[] = {
            Operator::Add,     Operator::Subtract,     Operator::Multiply, Operator::Negate,
            Operator::Equal,   Operator::NotEqual,     Operator::Less,     Operator::LessEqual,
            Operator::Greater, Operator::GreaterEqual, Operator::And,      Operator::Or,
            Operator::Not,     Operator::Equivalent,   Operator::Abs,      Operator::Minimum,
            Operator::Maximum};
        if (std::ranges::find(known, apply.op) == std::end(known)) return std::nullopt;
        Term term{Form::Apply};
        term.op = apply.op;
        return with_operands(std::move(term), apply.operands);
    }

    std::optional<Term> with_operands(Term made_term, const std::vector<ir::NodeId>& operands) {
        for (const ir::NodeId operand : operands) {
            const auto index = term(operand);
            if (!index) return std::nullopt;
            made_term.operands.push_back(*index);
            const int degree = condition.terms[*index].degree;
            made_term.degree = made_term.op == Operator::Multiply
                                   ? made_term.degree + degree
                                   : std::max(made_term.degree, degree);
        }
        return made_term.degree <= most_factors ? std::optional(std::move(made_term))
                                                : std::nullopt;
    }
};

}  // namespace

std::optional<ObjectCondition> object_condition(const ir::Program& program,
                                                std::span<const ir::Statement> lets,
                                                ir::NodeId condition, ir::VariableId object) {
    Making making{program, object};
    for (const ir::Statement& statement : lets) {
        const auto& let = std::get<ir::Let>(statement.form);
        making.locals[let.local] = let.value;
    }
    if (!making.term(condition)) return std::nullopt;
    return std::move(making.condition);
}

std::optional<std::pair<double, double>> ObjectCondition::constants_near(std::size_t number) const {
    std::vector<double> found;
    for (const Term& term : terms) {
        if (term.form != Form::Apply || term.operands.size() != 2) continue;
        if (!is_comparison(term.op) && term.op != Operator::Subtract) continue;
        for (std::size_t k = 0; k < 2; ++k) {
            const Term& one = terms[term.operands[k]];
            const Term& other = terms[term.operands[1 - k]];
            if (one.form == Form::Number && one.number == number && other.form == Form::Constant &&
                other.constants.size() > 1)
                found.insert(found.end(), other.constants.begin(), other.constants.end());
        }
    }
    if (found.empty()) return std::nullopt;
    const auto [least, greatest] = std::ranges::minmax(found);
    return std::pair(least, greatest);
}

}  // namespace rddlc::passes
