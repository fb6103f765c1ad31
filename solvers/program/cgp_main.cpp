// main() of a program that rddl_add_solver makes with SOLVER cgp.
#include "solvers/cgp/policy_file.hpp"
#include "solvers/cgp/trainee.hpp"
#include "solvers/program/program.hpp"

extern "C" const rddl_simulator* rddl_solver_simulator(void);

int main(int argc, char** argv) {
    using namespace rddlc::solvers;
    CgpOptions options;
    SolverProgram program;
    program.solver = "cgp";
    program.help = "  --gens N  --lambda N  --cols N  --islands N  --threads T\n"
        "  --memory-limit BYTES\n";
    add_number(program.options, "--gens", options.generations);
    add_number(program.options, "--lambda", options.children);
    add_number(program.options, "--cols", options.nodes);
    add_number(program.options, "--islands", options.islands);
    add_number(program.options, "--threads", options.threads);
    add_number(program.options, "--memory-limit", options.memory_limit);
    program.trainee = [&](const rddl_simulator& simulator, std::uint64_t seed, const Ranks& ranks) {
        options.seed = seed;
        return cgp_trainee(simulator, options, ranks);
    };
    program.read = [](const rddl_simulator& simulator, std::string_view text) {
        return program_policy(simulator, read_program(simulator, text), "cgp");
    };
    return run_solver_program(*rddl_solver_simulator(), program, argc, argv);
}
