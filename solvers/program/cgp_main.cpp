// main() of a program that rddl_add_solver makes with SOLVER cgp.
#include "solvers/cgp/option_table.hpp"
#include "solvers/cgp/policy_file.hpp"
#include "solvers/cgp/trainee.hpp"
#include "solvers/program/program.hpp"

extern "C" const rddl_simulator* rddl_solver_simulator(void);

int main(int argc, char** argv) {
    using namespace rddlc::solvers;
    CgpOptions options;
    SolverProgram program;
    program.solver = "cgp";
    add_options(program, cgp_option_table(), options);
    add_options(program, OptionTable<CgpOptions>{memory_option<CgpOptions>()}, options);
    program.trainee = [&](const rddl_simulator& simulator, std::uint64_t seed, const Ranks& ranks) {
        options.seed = seed;
        return cgp_trainee(simulator, options, ranks);
    };
    program.read = [](const rddl_simulator& simulator, std::string_view text) {
        return program_policy(simulator, read_program(simulator, text), "cgp");
    };
    return run_solver_program(*rddl_solver_simulator(), program, argc, argv);
}
