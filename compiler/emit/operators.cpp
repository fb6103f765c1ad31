#include "emit/operators.hpp"

#include "emit/identifiers.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace rddlc::cpp {
namespace {

OperatorSpelling call_of(std::string word) {
    return {std::move(word), false, Level::Primary, Level::Or, Level::Or, false};
}

OperatorSpelling infix(const char* word, Level own, Level left, Level right) {
    return {word, true, own, left, right, false};
}

// Of the other connective among the operands, readers and -Wparentheses want to see parentheses.
OperatorSpelling connective(const char* word, Level own) {
    return {word, true, own, Level::Comparison, Level::Comparison, true};
}

// Comparisons inside comparisons always get parentheses.
OperatorSpelling comparison(const char* word) {
    return infix(word, Level::Comparison, Level::Additive, Level::Additive);
}

// NegativeBinomial -> negative_binomial
std::string snake_case(std::string_view name) {
    std::string word;
    for (char c : name) {
        const bool upper = c >= 'A' && c <= 'Z';
        if (upper && !word.empty()) word += '_';
        word += upper ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return word;
}

std::string_view function_name(MatrixOperator op) {
    switch (op) {
        case MatrixOperator::Determinant:
            return "determinant";
        case MatrixOperator::Inverse:
            return "inverse";
        case MatrixOperator::PseudoInverse:
            return "pseudo_inverse";
        case MatrixOperator::Cholesky:
            return "cholesky";
    }
    throw std::logic_error("an unknown matrix function reached the emitter");
}

}  // namespace

// What is written otherwise than as a call of the runtime's function of the operator's name.
OperatorSpelling spelling_of(Operator op, bool on_ints) {
    if (on_ints) {
        if (op == Operator::Add) return call_of("wrap_add");
        if (op == Operator::Subtract) return call_of("wrap_sub");
        if (op == Operator::Multiply) return call_of("wrap_mul");
        if (op == Operator::Negate) return call_of("wrap_neg");
    }
    struct Row {
        Operator op;
        OperatorSpelling spelling;
    };
    static const Row rows[] = {
        {Operator::Add, infix("+", Level::Additive, Level::Additive, Level::Multiplicative)},
        {Operator::Subtract, infix("-", Level::Additive, Level::Additive, Level::Multiplicative)},
        {Operator::Multiply,
         infix("*", Level::Multiplicative, Level::Multiplicative, Level::Unary)},
        {Operator::Divide, infix("/", Level::Multiplicative, Level::Multiplicative, Level::Unary)},
        {Operator::Negate, infix("-", Level::Unary, Level::Primary, Level::Primary)},
        {Operator::Equal, comparison("==")},
        {Operator::Equivalent, comparison("==")},
        {Operator::NotEqual, comparison("!=")},
        {Operator::Less, comparison("<")},
        {Operator::LessEqual, comparison("<=")},
        {Operator::Greater, comparison(">")},
        {Operator::GreaterEqual, comparison(">=")},
        {Operator::And, connective("&&", Level::And)},
        {Operator::Or, connective("||", Level::Or)},
        {Operator::Not, infix("!", Level::Not, Level::Primary, Level::Primary)},
        {Operator::Implies, infix("||", Level::Or, Level::Primary, Level::Comparison)},
        {Operator::FloorModuloReal, call_of("floor_mod")},
    };
    const auto* row = std::ranges::find(rows, op, &Row::op);
    return row == std::end(rows) ? call_of(std::string(name_of(op))) : row->spelling;
}

std::string function_of(Reduction reduction) {
    switch (reduction) {
        case Reduction::Sum:
            return "sum";
        case Reduction::Product:
            return "product";
        case Reduction::Minimum:
            return "minimum_over";
        case Reduction::Maximum:
            return "maximum_over";
        case Reduction::ForAll:
            return "for_all";
        case Reduction::Exists:
            return "exists";
        case Reduction::ArgMin:
            return "arg_min";
        case Reduction::ArgMax:
            return "arg_max";
        case Reduction::Average:
            break;
    }
    throw std::logic_error("an average reached the emitter");
}

std::string function_of(Distribution distribution) {
    return snake_case(name_of(distribution));
}

std::string function_of(const ir::Program& program, const ir::Callee& callee) {
    return match(
        callee,
        [](MatrixOperator op) { return std::string("rddl::") + std::string(function_name(op)); },
        [](VectorDistribution distribution) {
            return "rddl::sample::" + snake_case(name_of(distribution));
        },
        [&](ir::ExternalId id) { return "rddl_extern::" + external_identifier(program[id].name); });
}

}  // namespace rddlc::cpp
