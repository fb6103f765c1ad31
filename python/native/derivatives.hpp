// Exact derivatives of steps.
#pragma once

#include <nanobind/nanobind.h>

namespace rddlc::python {

void add_derivatives(nanobind::module_& module);

}  // namespace rddlc::python
