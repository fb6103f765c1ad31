#include "solvers/drp/trainee.hpp"

#include "solvers/drp/trainer.hpp"
#include "solvers/ppo/policy.hpp"
#include "solvers/ppo/policy_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

namespace rddlc::solvers {

Trainee drp_trainee(const rddl_simulator& simulator, const DrpOptions& options,
                    const DerivativesSource& derivatives) {
    require_ranges(drp_option_table(), options);
    const auto trainer = std::make_shared<DrpTrainer>(simulator, options, derivatives);
    const auto total = static_cast<double>(options.steps);
    Trainee trainee;
    trainee.solver = "drp";
    trainee.advice = "more --steps, another --relax, --lr or --seed, or 'rddl train ppo'";
    trainee.settings = settings_of(drp_option_table(), trainer->options());
    trainee.ends_early = static_cast<bool>(options.stops);
    trainee.update = [=] {
        trainer->update();
    };
    trainee.update_until = [=](const Stops& is_late) {
        trainer->update(is_late);
    };
    trainee.done = [=] {
        return trainer->done();
    };
    trainee.steps = [=] {
        return trainer->progress().steps;
    };
    trainee.is_evaluated_by_time = true;
    trainee.part_done = [=] {
        return std::min(1.0, static_cast<double>(trainer->progress().steps) / total);
    };
    trainee.row = [=] {
        const DrpProgress& progress = trainer->progress();
        return Row{{"rollout/ep_disc_rew_mean", progress.mean_return},
                   {"train/gradients", static_cast<double>(progress.gradients)},
                   {"train/gradient_length", progress.gradient_length}};
    };
    trainee.status = [=] {
        const DrpProgress& progress = trainer->progress();
        const std::string made =
            fmt::format("{} steps  {} gradients", count_text(static_cast<double>(progress.steps)),
                        count_text(static_cast<double>(progress.gradients)));
        if (std::isnan(progress.mean_return)) return made;
        return fmt::format("{}  return {:.6g} (relaxed)", made, progress.mean_return);
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
        return ppo_policy(simulator, model, false, seed, "drp");
    };
    return trainee;
}

}  // namespace rddlc::solvers
