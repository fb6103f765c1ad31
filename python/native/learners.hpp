// The learners PPO, CGP and DRP, and the policies that they find.
#pragma once

#include <nanobind/nanobind.h>

namespace rddlc::python {

void add_learners(nanobind::module_& module);

}  // namespace rddlc::python
