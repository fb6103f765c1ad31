// Operators and distributions by number: the runtime's functions behind one switch for each
// signature. The builder folds with them and the evaluator runs on them.
#pragma once

#include "ir/ir.hpp"

#include <rddl/values/ops.hpp>

#include <cstdint>

namespace rddlc::ir {

using Context = rddl::Context<rddl::Scalar>;

[[noreturn]] void unreachable_operator();

// Equal to GreaterEqual, on two ints or two reals.
template <class T>
bool compare(Operator op, T a, T b) {
    switch (op) {
        case Operator::Equal:
            return a == b;
        case Operator::NotEqual:
            return a != b;
        case Operator::Less:
            return a < b;
        case Operator::LessEqual:
            return a <= b;
        case Operator::Greater:
            return a > b;
        case Operator::GreaterEqual:
            return a >= b;
        default:
            unreachable_operator();
    }
}

// Applies an operator to one or two bools; `b` is ignored by Not.
bool apply_logic(Operator op, bool a, bool b);
// Applies an operator to one or two ints, to int. `place` is used by Power.
std::int64_t apply_int(Operator op, std::int64_t a, std::int64_t b, rddl::Place place,
                       Context& context);
// Applies an operator to one real, to int: Sign, Round, Floor, Ceil.
std::int64_t apply_to_int(Operator op, double a);
// Applies an operator to one or two reals, to real. `place` is used by LnGamma, Gamma and Defined.
double apply_real(Operator op, double a, double b, rddl::Place place, Context& context);

// Draws, by the type of their value. A distribution of one parameter ignores `b`.
std::int64_t draw_int(Distribution distribution, double a, double b, rddl::Place place,
                      Context& context);
double draw_real(Distribution distribution, double a, double b, rddl::Place place,
                 Context& context);

}  // namespace rddlc::ir
