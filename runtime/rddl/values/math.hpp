// Elementary functions of reals, of our own, so that an environment's values are the same bits
// alone and in a pack, with every compiler and on every machine: they consist of IEEE + - * / and
// of operations on bits, in an order that no compiler may change (-ffp-contract=off). Accuracy,
// ranges, and the functions that are still the C library's: docs/mathematics.md.
//
// All are generic over the real type (rddl/lanes/real.hpp) and without branches, except around what
// rare arguments need, whose values are then selected lane by lane. Zeros, infinities, nan,
// subnormal numbers and overflow are as C has them, except that nothing sets errno or
// floating-point flags.
#pragma once

#include <rddl/values/math/exponential.hpp>
#include <rddl/values/math/hyperbolic.hpp>
#include <rddl/values/math/hypot.hpp>
#include <rddl/values/math/inverse_trigonometric.hpp>
#include <rddl/values/math/logarithm.hpp>
#include <rddl/values/math/power.hpp>
#include <rddl/values/math/remainder.hpp>
#include <rddl/values/math/single.hpp>
#include <rddl/values/math/trigonometric.hpp>
