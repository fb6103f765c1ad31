// Programs of CGP as text, with names of functions and inputs, and as policies.
#pragma once

#include "solvers/cgp/genome.hpp"
#include "solvers/cgp/scope.hpp"
#include "solvers/policies/policy.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace rddlc::solvers {

struct FoundProgram {
    ProgramScope scope;
    Genome genome;
};

std::string program_text(const rddl_simulator& simulator, const ProgramScope& scope,
                         const Genome& genome);

// The formula for readers, or the nodes of a delayed program.
std::string program_formula(const ProgramScope& scope, const Genome& genome);

// Whether it may be a program: of ours, or of scikit-decide.
bool is_program(std::string_view text);

// A lifted program may be of another instance of the domain. Throws a Failure with a sentence if
// the text is not a program, or is incomplete, of a newer version, or of another problem.
std::shared_ptr<const FoundProgram> read_program(const rddl_simulator& simulator,
                                                 std::string_view text);

// The simulator must outlive it.
Policy program_policy(const rddl_simulator& simulator, std::shared_ptr<const FoundProgram> program,
                      std::string name);

}  // namespace rddlc::solvers
