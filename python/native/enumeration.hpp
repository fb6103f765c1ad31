// Exact distributions of next states.
#pragma once

#include <nanobind/nanobind.h>

namespace rddlc::python {

void add_enumeration(nanobind::module_& module);

}  // namespace rddlc::python
