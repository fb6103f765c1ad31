// The compiler's driver as the commands use it.
#pragma once

#include "driver/driver.hpp"
#include "problem_lookup.hpp"

namespace rddlc::cli {

// Compiles up to a stage; prints nothing.
Compilation compile_problem(const ProblemFiles& files, Stage last);

// Prints all diagnostics on stderr; throws Diagnosed if there are errors.
void report(const Diagnostics& diagnostics, const Sources& sources);

// Both.
Compilation compile_and_report(const ProblemFiles& files, Stage last);

}  // namespace rddlc::cli
