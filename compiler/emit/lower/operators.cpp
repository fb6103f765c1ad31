#include "emit/lower/operators.hpp"

#include "emit/names/identifiers.hpp"
#include "support/match.hpp"

#include <stdexcept>

namespace rddlc::cpp {
namespace {

using tree::Level;
using Spelling = std::variant<tree::Operator, std::string>;

// Of the other connective among the operands, readers and -Wparentheses want to see parentheses.
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

Spelling spelling_of(Operator op, bool on_ints) {
    switch (op) {
        case Operator::Add:
            if (on_ints) return std::string("wrap_add");
            return tree::Operator{"+", Level::Additive, Level::Additive, Level::Multiplicative};
        case Operator::Subtract:
            if (on_ints) return std::string("wrap_sub");
            return tree::Operator{"-", Level::Additive, Level::Additive, Level::Multiplicative};
        case Operator::Multiply:
            if (on_ints) return std::string("wrap_mul");
            return tree::Operator{"*", Level::Multiplicative, Level::Multiplicative, Level::Unary};
        case Operator::Divide:
            return tree::Operator{"/", Level::Multiplicative, Level::Multiplicative, Level::Unary};
        case Operator::Negate:
            if (on_ints) return std::string("wrap_neg");
            return tree::Operator{"-", Level::Unary, Level::Primary, Level::Primary};
        case Operator::Equal:
        case Operator::Equivalent:
            return comparison("==");
        case Operator::NotEqual:
            return comparison("!=");
        case Operator::Less:
            return comparison("<");
        case Operator::LessEqual:
            return comparison("<=");
        case Operator::Greater:
            return comparison(">");
        case Operator::GreaterEqual:
            return comparison(">=");
        case Operator::And:
            return connective("&&", Level::And);
        case Operator::Or:
            return connective("||", Level::Or);
        case Operator::Not:
            return tree::Operator{"!", Level::Not, Level::Primary, Level::Primary};
        case Operator::Implies:  // behind a Not
            return tree::Operator{"||", Level::Or, Level::Not, Level::Comparison};
        case Operator::FloorModuloReal:
            return std::string("floor_mod");
        default:
            return std::string(name_of(op));
    }
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
