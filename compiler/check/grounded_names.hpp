// Names of groundings, p___a__b, in traces, requests and answers.
#pragma once

#include "check/context.hpp"

namespace rddlc::checking {

// Reports fluents of which two groundings have one name: with an object a__b, p(a__b, c) and
// p(a, b__c) are both p___a__b__c.
void check_grounded_names(Context& context);

}  // namespace rddlc::checking
