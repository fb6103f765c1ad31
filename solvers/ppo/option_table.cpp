#include "solvers/ppo/option_table.hpp"

#include "solvers/evaluation/threads.hpp"
#include "solvers/options/network_options.hpp"

namespace rddlc::solvers {

namespace {

using O = PpoOptions;
using Option = LearnerOption<O>;
using Time = ObservationOptions::Time;

// The names of the presets stand for the values that only they change.
Option preset_option() {
    Option option{
        {"--preset",
         "preset",
         "PRESET",
         "Settings: fast (default), sb3 (as Stable-Baselines3), rllib; later options override it",
         {},
         true,
         false,
         {"fast", "sb3", "rllib"}},
        {},
        {}};
    option.set = [](O& o, const std::vector<std::string>& words) {
        const auto known = preset(words.front());
        if (!known)
            throw OptionRefused(fmt::format("'{}' is not one of fast, sb3, rllib", words.front()));
        o = *known;
    };
    option.text = [](const O& o) -> std::string {
        if (o.kl_penalty > 0) return "rllib";
        return o.normalises_observations || o.normalises_rewards ? "fast" : "sb3";
    };
    return option;
}

// A size that users name is taken as it is, though it may not fit into memory.
template <class Member>
Option size_option(OptionText text, Member member) {
    Option option = number_option<O, int>(std::move(text), member, 1, 1 << 20);
    option.set = [set = option.set](O& o, const std::vector<std::string>& words) {
        set(o, words);
        o.names_rollout = true;
    };
    return option;
}

template <class Member>
Option real_option(OptionText text, Member member, double least, double most) {
    return number_option<O, double>(std::move(text), member, least, most);
}
template <class Member>
Option int_option(OptionText text, Member member, int least, int most) {
    return number_option<O, int>(std::move(text), member, least, most);
}

OptionTable<O> make_table() {
    return {
        preset_option(),
        number_option<O, std::int64_t>(
            {"--steps",
             "steps",
             "N",
             "Steps of all environments (1e6)",
             {"total_timesteps"},
             false},
            [](auto& o) -> auto& { return o.steps; }, 1, 1'000'000'000'000'000),
        size_option(
            {"--envs",
             "environments",
             "N",
             "Environments (64), on each rank of MPI",
             {"n_envs", "num_envs", "num_env_runners", "num_workers"}},
            [](auto& o) -> auto& { return o.environments; }),
        size_option(
            {"--rollout",
             "rollout",
             "T",
             "Steps of each environment between updates (128, or as many as fit into memory)",
             {"n_steps", "num_steps", "rollout_fragment_length", "train_batch_size"}},
            [](auto& o) -> auto& { return o.rollout; }),
        int_option(
            {"--epochs",
             "epochs",
             "E",
             "Passes over the collected samples (4)",
             {"n_epochs", "num_epochs", "num_sgd_iter"}},
            [](auto& o) -> auto& { return o.epochs; }, 1, 10000),
        int_option(
            {"--minibatch",
             "minibatch",
             "M",
             "Samples of a gradient step (1024), on each rank of MPI",
             {"batch_size", "minibatch_size", "sgd_minibatch_size"}},
            [](auto& o) -> auto& { return o.minibatch; }, 1, 1 << 30),
        positive_option<O>(
            {"--lr", "learning_rate", "RATE", "Learning rate (3e-4)"},
            [](auto& o) -> auto& { return o.learning_rate; }, 10),
        choice_option<O, LearningRate>(
            {"--lr-schedule", "schedule", "HOW",
             "Learning rate over time: linear (default): down to 0; constant; kl: adapts so "
             "that the policy moves evenly"},
            [](auto& o) -> auto& { return o.schedule; },
            {{"linear", LearningRate::Linear},
             {"constant", LearningRate::Constant},
             {"kl", LearningRate::Kl}}),
        real_option(
            {"--gamma",
             "gamma",
             "G",
             "Discount (0.99, or the instance's if lower)",
             {"discount", "discount_factor"}},
            [](auto& o) -> auto& { return o.gamma; }, 0, 1),
        real_option(
            {"--lambda",
             "gae_lambda",
             "L",
             "Lambda of generalised advantage estimation (0.95)",
             {"lambda_"}},
            [](auto& o) -> auto& { return o.lambda; }, 0, 1),
        positive_option<O>(
            {"--clip",
             "clip",
             "C",
             "Clip range of the probability ratio (0.2)",
             {"clip_range", "clip_param"}},
            [](auto& o) -> auto& { return o.clip; }, 10),
        real_option(
            {"--value-clip",
             "value_clip",
             "C",
             "Clip range of value estimates; 0 (default): no clipping",
             {"clip_range_vf", "vf_clip_param"}},
            [](auto& o) -> auto& { return o.value_clip; }, 0, 1e9),
        real_option(
            {"--value-weight",
             "value_weight",
             "W",
             "Weight of the value loss (0.5)",
             {"vf_coef", "vf_loss_coeff"}},
            [](auto& o) -> auto& { return o.value_weight; }, 0, 1e9),
        real_option(
            {"--entropy",
             "entropy",
             "W",
             "Weight of the entropy (0; 0.01 with choices)",
             {"ent_coef", "entropy_coeff"}},
            [](auto& o) -> auto& { return o.entropy_weight; }, 0, 1e9),
        real_option(
            {"--gradient-norm",
             "gradient_norm",
             "N",
             "Largest norm of the gradient (0.5); 0: no limit",
             {"max_grad_norm", "grad_clip"}},
            [](auto& o) -> auto& { return o.gradient_norm; }, 0, 1e9),
        real_option(
            {"--target-kl", "target_kl", "D",
             "End an update when the policy has moved by 1.5 times this KL divergence; "
             "0 (default): never"},
            [](auto& o) -> auto& { return o.kl_stop; }, 0, 1e9),
        choice_option<O, Noise>(
            {"--noise",
             "noise",
             "NOISE",
             "Exploration noise of reals: ar1 (default), correlated in time; sde, a function of "
             "the "
             "state that changes every "
             "few steps; or white",
             {"use_sde"}},
            [](auto& o) -> auto& { return o.noise; },
            {{"ar1", Noise::Ar1}, {"sde", Noise::Sde}, {"white", Noise::White}}),
        int_option(
            {"--sde-steps",
             "sde_steps",
             "N",
             "Steps for which sde keeps its function (8)",
             {"sde_sample_freq"}},
            [](auto& o) -> auto& { return o.noise_steps; }, 1, 1 << 20),
        real_option(
            {"--correlation", "correlation", "R", "Correlation of ar1 noise between steps (0.9)"},
            [](auto& o) -> auto& { return o.correlation; }, 0, 0.9999),
        real_option(
            {"--log-std",
             "log_std",
             "X",
             "Logarithm of the noise's first standard deviation (auto: 0, or -2 where that makes "
             "returns far worse than those of no-op)",
             {"log_std_init"}},
            [](auto& o) -> auto& { return o.log_deviation; }, -20, 5),
        switch_option<O>(
            {"--squash",
             "squash",
             "WHEN",
             "Bound reals by tanh of a normal number (on), or by clipping (off, default)",
             {"squash_output"}},
            [](auto& o) -> auto& { return o.squashes; }),
        switch_option<O>(
            {"--curiosity", "curiosity", "WHEN",
             "Reward for seeing more of the problem while nearly all episodes have "
             "the same return: on (default; off in sb3 and rllib), off"},
            [](auto& o) -> auto& { return o.curious; }),
        hidden_option<O>(),
        activation_option<O>(),
        int_option(
            {"--stack", "stack", "K", "Observations seen at once (1)", {"n_stack", "frame_stack"}},
            [](auto& o) -> auto& { return o.observations.stack; }, 1, most_stacked),
        int_option(
            {"--recurrent",
             "recurrent",
             "UNITS",
             "Gated recurrent units, a memory for partially observed problems; "
             "0 (default): no memory",
             {"use_lstm", "lstm_hidden_size", "lstm_cell_size"}},
            [](auto& o) -> auto& { return o.recurrent; }, 0, 1 << 14),
        int_option(
            {"--segment",
             "segment",
             "T",
             "Longest backpropagation through time, in steps (32)",
             {"max_seq_len"}},
            [](auto& o) -> auto& { return o.segment; }, 2, 1 << 20),
        choice_option<O, Time>(
            {"--time-input", "time_input", "WHEN",
             "Show the time to the policy: auto (default: horizons up to 200), on, off"},
            [](auto& o) -> auto& { return o.observations.time; },
            {{"auto", Time::Auto}, {"on", Time::On}, {"off", Time::Off}}),
        choice_option<O, std::optional<bool>>(
            {"--bootstrap", "bootstrap", "WHEN",
             "Estimate the value after the horizon: auto (default: unless the policy "
             "sees "
             "the time), on, off"},
            [](auto& o) -> auto& { return o.bootstraps; },
            {{"auto", std::nullopt}, {"on", true}, {"off", false}}),
        int_option(
            {"--threads", "threads", "T", "Threads (1)", {"n_jobs", "num_threads"}, false},
            [](auto& o) -> auto& { return o.threads; }, 1, most_threads)};
}

}  // namespace

const OptionTable<PpoOptions>& ppo_option_table() {
    static const OptionTable<PpoOptions> table = make_table();
    return table;
}

}  // namespace rddlc::solvers
