// Options that several subcommands share, so that they are spelled and explained alike.
#pragma once

#include "load_simulator.hpp"
#include "problem_lookup.hpp"
#include "violations.hpp"

#include <CLI/CLI.hpp>

#include <string>

namespace rddlc::cli {

// The positional arguments P.
struct ProblemArguments {
    std::string first;   // DOMAIN or NAME
    std::string second;  // INSTANCE; may be empty for a file that holds both blocks
    Standard standard = Standard::PyRddlGym;

    ProblemFiles files() const;
};
// These and --std.
void add_problem_arguments(CLI::App& command, ProblemArguments& arguments, bool required = true);

// --std
void add_standard_option(CLI::App& command, Standard& standard);

// --extern
void add_extern_option(CLI::App& command, LoadOptions& options, const std::string& explanation);

// --engine, --extern, --without, --fast-math, --real, --no-cache
void add_engine_options(CLI::App& command, LoadOptions& options);

// --preconditions
void add_preconditions_option(CLI::App& command, Preconditions& preconditions);

}  // namespace rddlc::cli
