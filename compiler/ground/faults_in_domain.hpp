// Faults that are certain whatever the instance is, such as Bernoulli(1.5).
#pragma once

#include "model/model.hpp"
#include "support/diagnostic.hpp"

namespace rddlc {

// Warns of them (W0601) in a domain that stands alone: a model without objects and values. With an
// instance ground() reports these and more.
void warn_of_faults_in_domain(const model::Model& domain, Diagnostics& diagnostics);

}  // namespace rddlc
