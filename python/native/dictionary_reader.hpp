// Values of a record as a dictionary.
#pragma once

#include <nanobind/nanobind.h>

namespace rddlc::python {

void add_dictionary_reader(nanobind::module_& module);

}  // namespace rddlc::python
