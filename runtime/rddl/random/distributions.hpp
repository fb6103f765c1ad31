// RDDL's distributions, as functions over the random numbers of a place:
//
//     sample::normal(context, {site, index}, mean, variance)
//
// A parameter outside its domain records a fault in the context and gives a harmless value. Laws,
// methods and checks are tabulated in docs/distributions.md.
#pragma once

#include <rddl/random/distributions/binomial.hpp>
#include <rddl/random/distributions/continuous.hpp>
#include <rddl/random/distributions/discrete.hpp>
#include <rddl/random/distributions/gamma.hpp>
#include <rddl/random/distributions/poisson.hpp>
#include <rddl/random/distributions/vectors.hpp>
