// main() of a program that rddl_add_solver makes with SOLVER ppo.
#include "solvers/ppo/option_table.hpp"
#include "solvers/ppo/policy.hpp"
#include "solvers/ppo/policy_file.hpp"
#include "solvers/ppo/trainee.hpp"
#include "solvers/program/program.hpp"

extern "C" const rddl_simulator* rddl_solver_simulator(void);

int main(int argc, char** argv) {
    using namespace rddlc::solvers;
    PpoOptions options;
    SolverProgram program;
    program.solver = "ppo";
    add_options(program, ppo_option_table(), options);
    add_options(program, OptionTable<PpoOptions>{memory_option<PpoOptions>()}, options);
    program.trainee = [&](const rddl_simulator& simulator, std::uint64_t seed, const Ranks& ranks) {
        options.seed = seed;
        return ppo_trainee(simulator, options, ranks);
    };
    program.read = [](const rddl_simulator& simulator, std::string_view text) {
        return ppo_policy(simulator, read_ppo_policy(simulator, text), false, 0, "ppo");
    };
    return run_solver_program(*rddl_solver_simulator(), program, argc, argv);
}
