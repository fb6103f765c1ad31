// main() of a program that rddl_add_solver makes with SOLVER ppo.
#include "solvers/ppo/policy_file.hpp"
#include "solvers/ppo/trainee.hpp"
#include "solvers/program/program.hpp"
#include "support/failure.hpp"

extern "C" const rddl_simulator* rddl_solver_simulator(void);

int main(int argc, char** argv) {
    using namespace rddlc::solvers;
    PpoOptions options;
    SolverProgram program;
    program.solver = "ppo";
    program.help =
        "  --steps N  --envs N  --rollout T  --epochs E  --minibatch M  --lr RATE  --gamma G\n"
        "  --stack K  --recurrent UNITS  --activation tanh|relu  --threads T\n"
        "  --memory-limit BYTES\n";
    add_number(program.options, "--steps", options.steps);
    add_number(program.options, "--envs", options.environments);
    add_number(program.options, "--rollout", options.rollout);
    add_number(program.options, "--epochs", options.epochs);
    add_number(program.options, "--minibatch", options.minibatch);
    add_number(program.options, "--lr", options.learning_rate);
    add_number(program.options, "--gamma", options.gamma);
    add_number(program.options, "--stack", options.observations.stack);
    add_number(program.options, "--recurrent", options.recurrent);
    add_number(program.options, "--threads", options.threads);
    add_number(program.options, "--memory-limit", options.memory_limit);
    program.options["--activation"] = [&](const std::string& word) {
        const auto known = activation_named(word);
        if (!known)
            throw rddlc::Failure("--activation: '" + word + "' is neither tanh nor relu", {},
                                 rddlc::usage_error);
        options.activation = *known;
    };
    program.trainee = [&](const rddl_simulator& simulator, std::uint64_t seed, const Ranks& ranks) {
        options.seed = seed;
        return ppo_trainee(simulator, options, ranks);
    };
    program.read = [](const rddl_simulator& simulator, std::string_view text) {
        return ppo_policy(simulator, read_ppo_policy(simulator, text), false, 0, "ppo");
    };
    return run_solver_program(*rddl_solver_simulator(), program, argc, argv);
}
