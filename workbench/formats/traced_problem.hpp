// Finds the problem of a trace.
#pragma once

#include "problems/problem_lookup.hpp"

#include <string>

namespace rddlc::workbench {

// The files that the trace was made with, as its header, which is this line, names them; warns of
// those that have changed since. Throws a Failure; `trace` is the name of the trace in messages.
ProblemFiles files_of_header(const std::string& line, const std::string& trace);

}  // namespace rddlc::workbench
