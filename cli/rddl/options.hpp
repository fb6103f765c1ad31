// Options that several subcommands share, so that they are spelled and explained alike.
#pragma once

#include "load_simulator.hpp"
#include "problem_lookup.hpp"
#include "violations.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <string>
#include <string_view>

namespace rddlc::cli {

// The decimal number that a word is; what is none, or lies beyond the bounds, is an error in the
// command line. CLI11 takes the nearest number that it can hold, reads 010 as 8, and lets nan pass.
template <class Number>
Number number_of(const std::string& option, std::string_view word, Number least, Number most) {
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool is_number = error == std::errc{} && end == word.data() + word.size();
    if (is_number && value >= least && value <= most) return value;
    throw CLI::ValidationError(
        option, fmt::format("'{}' is not {} from {} to {}", word,
                            std::is_integral_v<Number> ? "an int" : "a number", least, most));
}

// An option whose value is such a number; `target` may be a std::optional.
template <class Number, class Target>
void add_number_option(CLI::App& command, const std::string& option, Target& target, Number least,
                       Number most, const std::string& explanation, const char* type_name) {
    command
        .add_option_function<std::string>(
            option,
            [=, &target](const std::string& word) {
                target = number_of<Number>(option, word, least, most);
            },
            explanation)
        ->type_name(type_name);
}

// --seed and --horizon
template <class Seed, class Horizon>
void add_course_options(CLI::App& command, Seed& seed, const std::string& about_seed,
                        Horizon& horizon, const std::string& about_horizon) {
    add_number_option<std::uint64_t>(command, "--seed", seed, 0,
                                     std::numeric_limits<std::uint64_t>::max(), about_seed, "S");
    add_number_option<std::int64_t>(command, "--horizon", horizon, 0,
                                    std::numeric_limits<std::int64_t>::max(), about_horizon, "H");
}

inline constexpr int most_threads = 4096;
inline constexpr std::int64_t largest_batch = std::int64_t{1} << 24;

// The positional arguments P.
struct ProblemArguments {
    std::string first;   // DOMAIN or NAME
    std::string second;  // INSTANCE; may be empty for a file that holds both blocks
    Standard standard = Standard::PyRddlGym;
    std::int64_t memory_limit = default_memory_limit;

    ProblemFiles files() const;
};
// These, --std and --memory-limit.
void add_problem_arguments(CLI::App& command, ProblemArguments& arguments, bool required = true);

// --std
void add_standard_option(CLI::App& command, Standard& standard);

// --extern
void add_extern_option(CLI::App& command, LoadOptions& options, const std::string& explanation);

// --without, --fast-math
void add_pass_options(CLI::App& command, LoadOptions& options);

// --no-cache
void add_cache_option(CLI::App& command, LoadOptions& options);

// --engine, --extern, --without, --fast-math, --real, --no-cache
void add_engine_options(CLI::App& command, LoadOptions& options);

// --preconditions
void add_preconditions_option(CLI::App& command, Preconditions& preconditions);

}  // namespace rddlc::cli
