// PPO of RLtools on its own Pendulum: 4 environments x 1,024 steps, 2 epochs of minibatches of 256,
// networks of 64-64 units. rltools.py compiles it with the headers of the PyPI package `rltools`.
//
//   rltools UPDATES
#include <cstdlib>

// In the order that RLtools wants.
// clang-format off
#include <rl_tools/operations/cpu_mux.h>
#include <rl_tools/rl/environments/pendulum/operations_cpu.h>
#include <rl_tools/nn/optimizers/adam/instance/operations_generic.h>
#include <rl_tools/nn/operations_cpu_mux.h>
#include <rl_tools/nn/layers/standardize/operations_generic.h>
#include <rl_tools/nn_models/mlp_unconditional_stddev/operations_generic.h>
#include <rl_tools/nn_models/sequential/operations_generic.h>
#include <rl_tools/nn/optimizers/adam/operations_generic.h>
#include <rl_tools/rl/algorithms/ppo/loop/core/config.h>
#include <rl_tools/rl/algorithms/ppo/loop/core/operations_generic.h>
// clang-format on

// The activation of hidden layers: TANH as ours, or RELU as in RLtools' own example.
#ifndef ACTIVATION
#define ACTIVATION TANH
#endif

namespace rlt = rl_tools;
using Device = rlt::devices::DEVICE_FACTORY<>;
using Index = Device::index_t;
using Types = rlt::numeric_types::Policy<float>;
using Random = Device::SPEC::RANDOM::ENGINE<>;
using Pendulum =
    rlt::rl::environments::Pendulum<rlt::rl::environments::pendulum::Specification<float, Index>>;

struct Parameters
    : rlt::rl::algorithms::ppo::loop::core::DefaultParameters<Types, Index, Pendulum> {
    static constexpr Index N_ENVIRONMENTS = 4, ON_POLICY_RUNNER_STEPS_PER_ENV = 1024,
                           BATCH_SIZE = 256;
    static constexpr Index STEP_LIMIT = 1'000'000, EPISODE_STEP_LIMIT = 200;
    static constexpr Index DATASET_SIZE = ON_POLICY_RUNNER_STEPS_PER_ENV * N_ENVIRONMENTS;
    // The default is two hidden layers of 64.
    static constexpr auto ACTOR_ACTIVATION_FUNCTION =
        rlt::nn::activation_functions::ActivationFunction::ACTIVATION;
    static constexpr auto CRITIC_ACTIVATION_FUNCTION = ACTOR_ACTIVATION_FUNCTION;
    struct PPO_PARAMETERS : rlt::rl::algorithms::ppo::DefaultParameters<Types, Index, BATCH_SIZE> {
        static constexpr float GAMMA = 0.9f, ACTION_ENTROPY_COEFFICIENT = 0;
        static constexpr Index N_EPOCHS = 2;
    };
};
using Config =
    rlt::rl::algorithms::ppo::loop::core::Config<Types, Index, Random, Pendulum, Parameters>;

int main(int, char** words) {
    Device device;
    Config::State<Config> state;
    rlt::malloc(device, state);
    rlt::init(device, state, 0);
    for (long updates = std::atol(words[1]); updates > 0; --updates) rlt::step(device, state);
}
