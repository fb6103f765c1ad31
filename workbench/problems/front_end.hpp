// The compiler's driver as the commands use it.
#pragma once

#include "driver/driver.hpp"
#include "problems/problem_lookup.hpp"

namespace rddlc::workbench {

// To compile the problem up to a stage.
CompileOptions compile_options(const ProblemFiles& files, Stage last);

// The same for diagnostics only: a domain needs no instance.
CompileOptions check_options(const ProblemFiles& files, Stage last);

// Prints all diagnostics on stderr.
void print_diagnostics(const Compilation& compilation);

// Prints the warnings that stand in the file of files.policy, which `rddl check` does not read.
void print_policy_warnings(const Compilation& compilation, const ProblemFiles& files);

// If there are errors, prints all diagnostics and throws Diagnosed. Warnings alone are not shown:
// `rddl check` does that.
Compilation compile_or_give_up(const CompileOptions& options);
// The same of a compilation.
void give_up_on_errors(const Compilation& compilation);

}  // namespace rddlc::workbench
