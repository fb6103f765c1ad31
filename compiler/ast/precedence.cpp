#include "ast/precedence.hpp"

namespace rddlc::ast {

int precedence(BinaryOperator op) {
    switch (op) {
        case BinaryOperator::Equivalent:
            return 1;
        case BinaryOperator::Implies:
            return 2;
        case BinaryOperator::Or:
            return 3;
        case BinaryOperator::And:
            return 4;
        case BinaryOperator::Equal:
        case BinaryOperator::NotEqual:
        case BinaryOperator::Less:
        case BinaryOperator::LessEqual:
        case BinaryOperator::Greater:
        case BinaryOperator::GreaterEqual:
            return 5;
        case BinaryOperator::Add:
        case BinaryOperator::Subtract:
            return 6;
        case BinaryOperator::Multiply:
        case BinaryOperator::Divide:
            break;
    }
    return 7;
}

}  // namespace rddlc::ast
