// The description of a simulator's problem, as Python's own dictionaries and lists.
#pragma once

#include <rddl/simulator.h>

#include <nanobind/nanobind.h>

namespace rddlc::python {

nanobind::dict describe(const rddl_simulator& simulator);

// The values that the instance fixes, row-major: of a non-fluent, of a state-fluent at the start,
// the defaults of an action-fluent.
nanobind::list constants(const rddl_simulator& simulator, std::int32_t fluent);

}  // namespace rddlc::python
