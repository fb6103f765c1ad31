// RDDL's distributions, as functions over the random numbers of a place:
//
//     sample::normal(context, {site, index}, mean, variance)
//
// A parameter outside its domain records a fault in the context and gives a harmless value. Laws,
// methods and checks are tabulated in docs/distributions.md.
#pragma once

#include <rddl/distributions/binomial.hpp>
#include <rddl/distributions/continuous.hpp>
#include <rddl/distributions/discrete.hpp>
#include <rddl/distributions/gamma.hpp>
#include <rddl/distributions/poisson.hpp>
#include <rddl/distributions/vectors.hpp>
