// The runtime's functions for operators and distributions. The builder folds with them, and the
// evaluator runs on them.
#pragma once

#include "vocabulary/vocabulary.hpp"

#include <rddl/values/ops.hpp>

#include <cstdint>

namespace rddlc {

using Context = rddl::Context<rddl::Scalar>;

// The one or two operands of an operator, or parameters of a draw. With one, `b` is not looked at.
// The place is that of a draw, or of an operator that may fault.
template <class T>
struct Operands {
    T a, b;
    rddl::Place place;
    Context& context;
};

// A kernel is missing (null) where the typing of its operator does not ask for it.
struct OperatorKernels {
    bool (*of_bools)(bool, bool) = nullptr;
    std::int64_t (*of_ints)(const Operands<std::int64_t>&) = nullptr;
    double (*of_reals)(const Operands<double>&) = nullptr;
    std::int64_t (*to_int)(double) = nullptr;
};

// Comparisons of ints and reals are not here: see compare().
const OperatorKernels& kernels_of(Operator op);

// Equal to GreaterEqual, on two ints or two reals.
template <class T>
bool compare(Operator op, T a, T b) {
    if (op == Operator::Equal) return a == b;
    if (op == Operator::NotEqual) return a != b;
    if (op == Operator::Less) return a < b;
    if (op == Operator::LessEqual) return a <= b;
    if (op == Operator::Greater) return a > b;
    return a >= b;
}

// Draws, by the type of their value. Bernoulli and Binomial are drawn by rddl::sample's functions
// of these names: their parameters differ in type, and verification lists their outcomes.
std::int64_t draw_int(Distribution distribution, const Operands<double>& parameters);
double draw_real(Distribution distribution, const Operands<double>& parameters);

// Whether a draw with these parameters has one result only, such as a normal one without variance.
bool is_certain(Distribution distribution, double a, double b);

}  // namespace rddlc
