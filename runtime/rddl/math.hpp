// Elementary functions of reals, of our own, so that an environment's values are the same bits
// alone and in a pack, with every compiler and on every machine: they consist of IEEE + - * / and
// of operations on bits, in an order that no compiler may change (-ffp-contract=off). Accuracy,
// ranges, and the functions that are still the C library's: docs/mathematics.md.
//
// All are generic over the real type (rddl/real.hpp) and without branches, except around what rare
// arguments need, whose values are then selected lane by lane. Zeros, infinities, nan, subnormal
// numbers and overflow are as C has them, except that nothing sets errno or floating-point flags.
#pragma once

#include <rddl/math/exponential.hpp>
#include <rddl/math/hyperbolic.hpp>
#include <rddl/math/hypot.hpp>
#include <rddl/math/inverse_trigonometric.hpp>
#include <rddl/math/logarithm.hpp>
#include <rddl/math/power.hpp>
#include <rddl/math/remainder.hpp>
#include <rddl/math/single.hpp>
#include <rddl/math/trigonometric.hpp>
