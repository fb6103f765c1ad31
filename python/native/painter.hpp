// Pictures of a running episode.
#pragma once

#include <nanobind/nanobind.h>

namespace rddlc::python {

void add_painter(nanobind::module_& module);

}  // namespace rddlc::python
