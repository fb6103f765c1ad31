// The derivative of each operator and each distribution by its operands a and b; `v` is the value.
#pragma once

#include "vocabulary/vocabulary.hpp"

namespace rddlc::autodiff {

struct Partials {
    double a = 0, b = 0;
};

// Operators of reals.
Partials of_operator(Operator op, double a, double b, double v);
// Operators of ints. Polynomials have the derivatives of reals; division and powers have them only
// if ints are relaxed.
Partials of_int_operator(Operator op, double a, double b, double v, bool is_relaxed);
// Product logic: a ^ b is a * b.
Partials of_logic(Operator op, double a, double b);
// Sigmoids and squared hyperbolic tangents of sharpness * (a - b).
Partials of_comparison(Operator op, double a, double b, double sharpness);
// Sign, Round, Floor and Ceil.
Partials of_rounding(Operator op, double a, double sharpness);
// Reparameterised: the derivative of the draw with the same random number (Kingma and Welling,
// 2014). The shape of Gamma, and the parameters of Beta, Student and ChiSquare, count as constants:
// their draws are not by inversion.
Partials of_real_draw(Distribution distribution, double a, double b, double v);
// The derivative of the mean of the draw.
Partials of_int_draw(Distribution distribution, double a, double b);

}  // namespace rddlc::autodiff
