// A solver and one problem as a program by itself, without compiler and RDDL files
// (rddl_add_solver in CMake).
#pragma once

#include "solvers/options/options.hpp"
#include "solvers/policies/policy.hpp"
#include "solvers/training/training.hpp"

#include <rddl/simulator.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::solvers {

// An option of a program, and what takes the words of its value. They are set in the order in which
// the program lists them.
struct ProgramOption : OptionText {
    std::function<void(const std::vector<std::string>&)> set;
};

struct SolverProgram {
    std::string solver;                  // "ppo"
    std::vector<ProgramOption> options;  // of training, beside those of every training
    std::function<Trainee(const rddl_simulator&, std::uint64_t seed, const Ranks&)> trainee;
    std::function<Policy(const rddl_simulator&, std::string_view text)> read;
};

// The program's exit status: NAME train ..., NAME evaluate POLICY ....
int run_solver_program(const rddl_simulator& simulator, const SolverProgram& program, int argc,
                       char** argv);

// All options of a learner's table. `options` must outlive the program.
template <class Options>
void add_options(SolverProgram& program, const OptionTable<Options>& table, Options& options) {
    for (const LearnerOption<Options>& option : table)
        program.options.push_back(
            {option, [&options, set = option.set](const std::vector<std::string>& words) {
                 set(options, words);
             }});
}

}  // namespace rddlc::solvers
