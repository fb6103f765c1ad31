#include "emit/lower/operators.hpp"

#include "emit/names/identifiers.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace rddlc::cpp {
namespace {

using tree::Level;
using Spelling = std::variant<tree::Operator, std::string>;

// Readers and -Wparentheses expect parentheses around an operand that is the other connective.
tree::Operator connective(const char* word, Level own) {
    return {word, own, Level::Comparison, Level::Comparison, true};
}

// Comparisons inside comparisons always get parentheses.
tree::Operator comparison(const char* word) {
    return {word, Level::Comparison, Level::Additive, Level::Additive};
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

tree::Operator plain_operator(Operator op) {
    return std::get<tree::Operator>(spelling_of(op, false));
}

// Every other operator is a call of the runtime's function of its name.
Spelling spelling_of(Operator op, bool on_ints) {
    if (on_ints) {
        if (op == Operator::Add) return std::string("wrap_add");
        if (op == Operator::Subtract) return std::string("wrap_sub");
        if (op == Operator::Multiply) return std::string("wrap_mul");
        if (op == Operator::Negate) return std::string("wrap_neg");
    }
    struct Row {
        Operator op;
        Spelling spelling;
    };
    using Infix = tree::Operator;
    static const Row rows[] = {
        {Operator::Add, Infix{"+", Level::Additive, Level::Additive, Level::Multiplicative}},
        {Operator::Subtract, Infix{"-", Level::Additive, Level::Additive, Level::Multiplicative}},
        {Operator::Multiply,
         Infix{"*", Level::Multiplicative, Level::Multiplicative, Level::Unary}},
        {Operator::Divide, Infix{"/", Level::Multiplicative, Level::Multiplicative, Level::Unary}},
        {Operator::Negate, Infix{"-", Level::Unary, Level::Primary, Level::Primary}},
        {Operator::Equal, comparison("==")},
        {Operator::Equivalent, comparison("==")},
        {Operator::NotEqual, comparison("!=")},
        {Operator::Less, comparison("<")},
        {Operator::LessEqual, comparison("<=")},
        {Operator::Greater, comparison(">")},
        {Operator::GreaterEqual, comparison(">=")},
        {Operator::And, connective("&&", Level::And)},
        {Operator::Or, connective("||", Level::Or)},
        {Operator::Not, Infix{"!", Level::Not, Level::Primary, Level::Primary}},
        {Operator::Implies, Infix{"||", Level::Or, Level::Not, Level::Comparison}},  // behind a Not
        {Operator::FloorModuloReal, std::string("floor_mod")},
    };
    const auto* row = std::ranges::find(rows, op, &Row::op);
    return row == std::end(rows) ? Spelling(std::string(name_of(op))) : row->spelling;
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
        [&](ir::ExternalId id) { return "rddl_extern::" + external_identifier(program[id].name); },
        [](ir::Together) { return std::string("rddl::evaluate_together"); });
}

}  // namespace rddlc::cpp
