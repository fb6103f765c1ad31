// Solutions of problems: an optimal policy with its value, as a file that --policy takes.
#pragma once

#include "engines/load_simulator.hpp"
#include "exact/dynamic_programming.hpp"
#include "exact/markov_model.hpp"
#include "solvers/files/fingerprint.hpp"
#include "solvers/policies/policy.hpp"

#include <rddl/simulator.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::workbench {

// The ending of such a file.
inline constexpr const char* solution_ending = ".optimum";

struct Solution {
    solvers::Fingerprint problem;
    Optimum optimum;
    std::vector<std::byte> states, actions;  // records, one after the other
};

struct SolveOptions {
    ModelLimits limits;  // a horizon of 0 is the problem's; -1: none
    std::int64_t actions = 4096;
    bool cheat = false;  // a problem that hides its state is solved as if it did not
};

// How large the problem was.
struct SolvedSize {
    std::int64_t states = 0, actions = 0, transitions = 0;
    double possible_states = 0;  // as the fluents' ranges have it; may be infinite
};

// Solves the problem that these files hold. Throws a Failure with a sentence where it is not
// discrete, not finite or too large.
Solution solve(const ProblemFiles& files, const LoadOptions& load, const SolveOptions& options,
               SolvedSize& size);

std::string solution_text(const Solution& solution);
// Throws a Failure where the bytes are damaged or of another problem.
Solution read_solution(const rddl_simulator& simulator, std::string_view text);

// Acts by the solution, which it throws a Failure about where a state, or so many steps, are not
// part of it.
solvers::Policy solution_policy(const rddl_simulator& simulator, Solution solution,
                                const std::string& name);

}  // namespace rddlc::workbench
