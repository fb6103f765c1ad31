// A problem as Python loads it.
#pragma once

#include "engines/load_simulator.hpp"

#include <nanobind/nanobind.h>

#include <stdexcept>
#include <string>

namespace rddlc::python {

// Mistakes in a problem's files: what() is all that the compiler says of them.
struct CompileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// An argument that cannot be; what() is a sentence. It is an ArgumentError of Python, as is a
// Failure that a command line would end for with the status of wrong usage.
struct Refused : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Throws Refused, with the simulator's reason, if a function of it has failed.
void check(const rddl_simulator& simulator, rddl_error error);

void add_problem(nanobind::module_& module);

}  // namespace rddlc::python
