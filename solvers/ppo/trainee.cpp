#include "solvers/ppo/trainee.hpp"

#include "solvers/ppo/option_table.hpp"
#include "solvers/ppo/policy.hpp"
#include "solvers/ppo/policy_file.hpp"
#include "solvers/ppo/trainer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace rddlc::solvers {

namespace {

// The work of this process: a resumed run has steps that others made.
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
            {"rollout/repaired_actions", progress.repaired_rate},
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

}  // namespace

Trainee ppo_trainee(const rddl_simulator& simulator, const PpoOptions& options, const Ranks& ranks,
                    const Demonstrate& demonstrate) {
    require_ranges(ppo_option_table(), options);
    const auto trainer = std::make_shared<PpoTrainer>(simulator, options, ranks);
    const auto work = std::make_shared<Work>();
    const auto total = static_cast<double>(options.steps);
    Trainee trainee;
    trainee.solver = "ppo";
    trainee.advice =
        "more --steps, another --seed, to begin as a planner or no-op acts (rddl train ppo "
        "--imitate plan:cem), or 'rddl train cgp'";
    trainee.settings = settings_of(ppo_option_table(), trainer->options());
    if (const int rollout = trainer->options().rollout; rollout != options.rollout)
        trainee.note = fmt::format("--rollout is {} in place of {}, since this problem is large",
                                   rollout, options.rollout);
    if (const double first = *trainer->options().log_deviation;
        !options.log_deviation && first != 0)
        trainee.note += fmt::format(
            "{}--log-std is {}, since noise of deviation 1 has far worse returns than no-op",
            trainee.note.empty() ? "" : "; ", first);
    trainee.ends_early = static_cast<bool>(options.stops);
    if (demonstrate)
        trainee.prepare = [=] {
            const Demonstrations shown = demonstrate(trainer->model());
            trainer->imitate(shown);
            return fmt::format("{} steps are imitated, whose episodes return {:.6g}", shown.count(),
                               shown.returns.mean);
        };
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
