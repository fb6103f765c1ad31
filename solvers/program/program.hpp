// A solver and one problem as a program by itself, without compiler and RDDL files
// (rddl_add_solver in CMake).
#pragma once

#include "solvers/policies/policy.hpp"
#include "solvers/training/training.hpp"

#include <rddl/simulator.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace rddlc::solvers {

// Options that the solver takes beside those of every training: by name, with what takes the word.
using WordTakers = std::map<std::string, std::function<void(const std::string&)>>;

struct SolverProgram {
    std::string solver;  // "ppo"
    std::string help;    // lines about its options
    WordTakers options;  // "--steps"
    std::function<Trainee(const rddl_simulator&, std::uint64_t seed, const Ranks&)> trainee;
    std::function<Policy(const rddl_simulator&, std::string_view text)> read;
};

// The program's exit status: NAME train ..., NAME evaluate POLICY ....
int run_solver_program(const rddl_simulator& simulator, const SolverProgram& program, int argc,
                       char** argv);

// The number that a word is; a Failure if it is none.
double number_in(const std::string& option, const std::string& word);

// The option's word is that number, which must live as long as the options.
template <class Number>
void add_number(WordTakers& options, const std::string& name, Number& number) {
    options[name] = [name, &number](const std::string& word) {
        number = static_cast<Number>(number_in(name, word));
    };
}

}  // namespace rddlc::solvers
