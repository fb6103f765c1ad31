// main() of a program that rddl_add_solver makes with SOLVER ppo.
#include "solvers/ppo/policy_file.hpp"
#include "solvers/ppo/trainee.hpp"
#include "solvers/program/program.hpp"

extern "C" const rddl_simulator* rddl_solver_simulator(void);

int main(int argc, char** argv) {
    using namespace rddlc::solvers;
    PpoOptions options;
    SolverProgram program;
    program.solver = "ppo";
    program.help =
        "  --steps N  --envs N  --rollout T  --epochs E  --minibatch M  --lr RATE  --gamma G\n"
        "  --threads T\n";
    const auto take = [&](const char* name, auto& number) {
        program.options[name] = [name, &number](const std::string& word) {
            number = static_cast<std::remove_reference_t<decltype(number)>>(number_in(name, word));
        };
    };
    take("--steps", options.steps);
    take("--envs", options.environments);
    take("--rollout", options.rollout);
    take("--epochs", options.epochs);
    take("--minibatch", options.minibatch);
    take("--lr", options.learning_rate);
    take("--gamma", options.gamma);
    take("--threads", options.threads);
    program.trainee = [&](const rddl_simulator& simulator, std::uint64_t seed) {
        options.seed = seed;
        return ppo_trainee(simulator, options);
    };
    program.read = [](const rddl_simulator& simulator, std::string_view text) {
        return ppo_policy(simulator, read_ppo_policy(simulator, text), false, 0, "ppo");
    };
    return run_solver_program(*rddl_solver_simulator(), program, argc, argv);
}
