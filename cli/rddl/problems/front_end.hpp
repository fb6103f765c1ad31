// The compiler's driver as the commands use it.
#pragma once

#include "driver/driver.hpp"
#include "problems/problem_lookup.hpp"

namespace rddlc::cli {

// Compiles up to a stage; prints nothing.
Compilation compile_problem(const ProblemFiles& files, Stage last,
                            const std::vector<std::filesystem::path>& extern_headers = {},
                            const PassOptions& passes = {}, RealType real = RealType::Double);

// The same for the sake of the diagnostics alone: a domain needs no instance.
Compilation check_problem(const ProblemFiles& files, Stage last,
                          const std::vector<std::filesystem::path>& extern_headers = {});

// Prints all diagnostics on stderr.
void print_diagnostics(const Compilation& compilation);

// If there are errors, prints all diagnostics and throws Diagnosed. Warnings alone are not shown:
// `rddl check` does that.
Compilation compile_or_give_up(const ProblemFiles& files, Stage last,
                               const std::vector<std::filesystem::path>& extern_headers = {},
                               const PassOptions& passes = {}, RealType real = RealType::Double);
// The same of a compilation.
void give_up_on_errors(const Compilation& compilation);

}  // namespace rddlc::cli
