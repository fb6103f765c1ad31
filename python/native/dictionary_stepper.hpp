// A step by a dictionary, from the action to the observation, in one call.
#pragma once

#include <nanobind/nanobind.h>

namespace rddlc::python {

void add_dictionary_stepper(nanobind::module_& module);

}  // namespace rddlc::python
