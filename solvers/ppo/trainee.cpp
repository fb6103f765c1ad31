#include "solvers/ppo/trainee.hpp"

#include "solvers/ppo/policy_file.hpp"
#include "solvers/ppo/trainer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

namespace rddlc::solvers {

namespace {

// What this process has done: a run that goes on has steps that others made.
struct Work {
    std::int64_t steps_before = 0;
    double seconds = 0;

    double steps_per_second(const PpoProgress& progress) const {
        return seconds > 0 ? static_cast<double>(progress.steps - steps_before) / seconds : 0;
    }
};

Row ppo_row(const PpoProgress& progress, const Work& work) {
    const double rollout = std::max(progress.collect_seconds + progress.learn_seconds, 1e-9);
    return {{"rollout/ep_rew_mean", progress.mean_return},
            {"rollout/ep_disc_rew_mean", progress.mean_discounted_return},
            {"rollout/ep_len_mean", progress.mean_length},
            {"rollout/success_rate", progress.success_rate},
            {"rollout/mended_actions", progress.mended_rate},
            {"time/fps", work.steps_per_second(progress)},
            {"time/sim_share", progress.simulator_seconds / rollout},
            {"train/approx_kl", progress.kl},
            {"train/clip_fraction", progress.clip_fraction},
            {"train/entropy_loss", -progress.entropy},
            {"train/explained_variance", progress.explained_variance},
            {"train/learning_rate", progress.learning_rate},
            {"train/policy_gradient_loss", progress.policy_loss},
            {"train/std", progress.deviation},
            {"train/value_loss", progress.value_loss}};
}

std::string ppo_status(const PpoProgress& progress, const Work& work) {
    return fmt::format("{} steps  {} steps/s  return {:.6g}  length {:.0f}  kl {:.4f}  ev {:.2f}",
                       count_text(static_cast<double>(progress.steps)),
                       count_text(work.steps_per_second(progress)), progress.mean_return,
                       progress.mean_length, progress.kl, progress.explained_variance);
}

// What the presets alone change is told by their names.
const char* preset_of(const PpoOptions& options) {
    if (options.kl_penalty > 0) return "rllib";
    return options.normalises_observations || options.normalises_rewards ? "fast" : "sb3";
}

std::string name_of(LearningRate schedule) {
    return schedule == LearningRate::Linear ? "linear"
           : schedule == LearningRate::Kl   ? "kl"
                                            : "constant";
}

const char* on_or_off(bool is_on) {
    return is_on ? "on" : "off";
}

const char* name_of(ObservationOptions::Time time) {
    return time == ObservationOptions::Time::Auto ? "auto"
                                                  : on_or_off(time == ObservationOptions::Time::On);
}

// All but --steps, by which a run may go on for longer, and --threads.
Settings ppo_settings(const PpoOptions& o) {
    const auto text = [](const auto& value) {
        return fmt::format("{}", value);
    };
    return {{"--preset", preset_of(o)},
            {"--envs", text(o.environments)},
            {"--rollout", text(o.rollout)},
            {"--epochs", text(o.epochs)},
            {"--minibatch", text(o.minibatch)},
            {"--lr", text(o.learning_rate)},
            {"--lr-schedule", name_of(o.schedule)},
            {"--gamma", text(o.gamma)},
            {"--lambda", text(o.lambda)},
            {"--clip", text(o.clip)},
            {"--value-clip", text(o.value_clip)},
            {"--value-weight", text(o.value_weight)},
            {"--entropy", o.entropy_weight ? text(*o.entropy_weight) : "auto"},
            {"--gradient-norm", text(o.gradient_norm)},
            {"--target-kl", text(o.kl_stop)},
            {"--noise", name_of(o.noise)},
            {"--sde-steps", text(o.noise_steps)},
            {"--correlation", text(o.correlation)},
            {"--log-std", text(o.log_deviation)},
            {"--squash", on_or_off(o.squashes)},
            {"--curiosity", on_or_off(o.curious)},
            {"--hidden", fmt::format("{}", fmt::join(o.hidden, ","))},
            {"--activation", name_of(o.activation)},
            {"--stack", text(o.observations.stack)},
            {"--recurrent", text(o.recurrent)},
            {"--segment", text(o.segment)},
            {"--time-input", name_of(o.observations.time)},
            {"--bootstrap", o.bootstraps ? on_or_off(*o.bootstraps) : "auto"}};
}

}  // namespace

Trainee ppo_trainee(const rddl_simulator& simulator, const PpoOptions& options,
                    const Ranks& ranks) {
    const auto trainer = std::make_shared<PpoTrainer>(simulator, options, ranks);
    const auto work = std::make_shared<Work>();
    const auto total = static_cast<double>(options.steps);
    Trainee trainee;
    trainee.solver = "ppo";
    trainee.settings = ppo_settings(trainer->options());
    if (const int rollout = trainer->options().rollout; rollout != options.rollout)
        trainee.note = fmt::format("--rollout is {} in place of {}, since this problem is large",
                                   rollout, options.rollout);
    trainee.ends_early = static_cast<bool>(options.stops);
    trainee.update = [=] {
        trainer->update();
        work->seconds += trainer->progress().collect_seconds + trainer->progress().learn_seconds;
    };
    trainee.done = [=] {
        return trainer->done();
    };
    trainee.steps = [=] {
        return trainer->progress().steps;
    };
    trainee.part_done = [=] {
        return std::min(1.0, static_cast<double>(trainer->progress().steps) / total);
    };
    trainee.row = [=] {
        return ppo_row(trainer->progress(), *work);
    };
    trainee.status = [=] {
        return ppo_status(trainer->progress(), *work);
    };
    trainee.save = [=] {
        return trainer->save();
    };
    trainee.load = [=](std::string_view bytes) {
        trainer->load(bytes);
        work->steps_before = trainer->progress().steps;
    };
    trainee.policy_text = [=, &simulator] {
        return ppo_policy_text(simulator, trainer->model());
    };
    trainee.policy = [=, &simulator, seed = options.seed] {
        const auto model = std::make_shared<PpoModel>(trainer->model());
        return ppo_policy(simulator, model, false, seed, "ppo");
    };
    return trainee;
}

}  // namespace rddlc::solvers
