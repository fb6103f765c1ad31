// Options that several subcommands share, so that they are spelled and explained alike. The
// variables that they write must outlive the command.
#pragma once

#include "command_line/command_line.hpp"
#include "commands/commands.hpp"
#include "engines/load_simulator.hpp"
#include "pictures/charts.hpp"
#include "pictures/picture_options.hpp"
#include "problems/problem_lookup.hpp"
#include "rollouts/rollouts.hpp"
#include "rollouts/violations.hpp"
#include "solvers/evaluation/threads.hpp"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>

namespace rddlc::cli {

using solvers::most_threads;
inline constexpr std::int64_t largest_batch = std::int64_t{1} << 24;
inline constexpr std::int64_t longest_horizon = std::numeric_limits<std::int64_t>::max();

// The positional arguments P.
struct ProblemArguments {
    std::string first;   // DOMAIN or NAME
    std::string second;  // INSTANCE; may be empty for a file that holds both blocks
    std::string instance_name;
    Standard standard = Standard::PyRddlGym;
    std::int64_t memory_limit = default_memory_limit;

    ProblemFiles files() const;
    // Others, read as the options say.
    ProblemFiles with_options(ProblemFiles files) const;
};
// These, --instance, --std and --memory-limit.
void add_problem_arguments(Command& command, ProblemArguments& arguments, bool required = true);

// --seed; may be a std::optional
template <class Seed>
void add_seed_option(Command& command, Seed& seed, const std::string& explanation) {
    add_number_option<std::uint64_t>(command, "--seed", "S", explanation, seed, 0,
                                     std::numeric_limits<std::uint64_t>::max());
}

// --horizon; may be a std::optional
template <class Horizon>
void add_horizon_option(Command& command, Horizon& horizon, const std::string& explanation) {
    add_number_option<std::int64_t>(command, "--horizon", "H", explanation, horizon, 0,
                                    longest_horizon);
}

// An episode that nothing ends would keep a command that has --horizon busy for ever: throws a
// Failure then. `horizon` is that of the option, or else the problem's.
void require_an_end(const rddl_problem& problem, std::int64_t horizon);

// --std
void add_standard_option(Command& command, Standard& standard);

// --extern
void add_extern_option(Command& command, LoadOptions& options, const std::string& explanation);

// --without, --fast-math
void add_pass_options(Command& command, LoadOptions& options);

// --no-cache
void add_cache_option(Command& command, LoadOptions& options);

// --engine, --extern, --without, --fast-math, --real, --no-cache
void add_engine_options(Command& command, LoadOptions& options);

// --policy; a file gives its policy block or, if `rollouts` is not null, a learned policy. Planners
// are accepted if `rollouts` is not null.
void add_policy_option(Command& command, Policy& policy, std::optional<std::filesystem::path>& file,
                       RolloutOptions* rollouts = nullptr);

// --cheat, --explain-decisions
void add_planner_options(Command& command, PlannerSettings& planning);

// --size
void add_size_option(Command& command, int& width, int& height, const std::string& explanation);

// The pictures to draw, and their files.
void add_picture_options(Command& command, PictureOptions& options);

// --png, --svg, --size
void add_chart_options(Command& command, ChartFiles& files);

// --preconditions
void add_preconditions_option(Command& command, Preconditions& preconditions);

}  // namespace rddlc::cli
