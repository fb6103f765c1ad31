#include "solvers/ppo/trainee.hpp"

#include "solvers/ppo/policy_file.hpp"
#include "solvers/ppo/trainer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace rddlc::solvers {

namespace {

Row ppo_row(const PpoProgress& progress, double seconds) {
    const double all = std::max(seconds, 1e-9);
    const double rollout = std::max(progress.collect_seconds + progress.learn_seconds, 1e-9);
    return {{"rollout/ep_rew_mean", progress.mean_return},
            {"rollout/ep_disc_rew_mean", progress.mean_discounted_return},
            {"rollout/ep_len_mean", progress.mean_length},
            {"rollout/success_rate", progress.success_rate},
            {"rollout/mended_actions", progress.mended_rate},
            {"time/fps", static_cast<double>(progress.steps) / all},
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

std::string ppo_status(const PpoProgress& progress, double seconds) {
    return fmt::format("{} steps  {} steps/s  return {:.6g}  length {:.0f}  kl {:.4f}  ev {:.2f}",
                       count_text(static_cast<double>(progress.steps)),
                       count_text(static_cast<double>(progress.steps) / std::max(seconds, 1e-9)),
                       progress.mean_return, progress.mean_length, progress.kl,
                       progress.explained_variance);
}

}  // namespace

Trainee ppo_trainee(const rddl_simulator& simulator, const PpoOptions& options,
                    const Ranks& ranks) {
    const auto trainer = std::make_shared<PpoTrainer>(simulator, options, ranks);
    const auto seconds = std::make_shared<double>(0);
    const auto total = static_cast<double>(options.steps);
    Trainee trainee;
    trainee.solver = "ppo";
    trainee.update = [=] {
        trainer->update();
        *seconds += trainer->progress().collect_seconds + trainer->progress().learn_seconds;
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
        return ppo_row(trainer->progress(), *seconds);
    };
    trainee.status = [=] {
        return ppo_status(trainer->progress(), *seconds);
    };
    trainee.save = [=] {
        return trainer->save();
    };
    trainee.load = [=](std::string_view bytes) {
        trainer->load(bytes);
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
