#include "solvers/ppo/demonstrations.hpp"

#include "solvers/batches/batch.hpp"
#include "solvers/spaces/actions.hpp"
#include "solvers/spaces/observations.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace rddlc::solvers {

namespace {

// The episodes of one batch, which run side by side, and then one after the other in `all`.
class DemonstrationRecorder : public Recorder {
  public:
    DemonstrationRecorder(const rddl_simulator& simulator, const PpoModel& model,
                          std::int64_t environments, Demonstrations& all)
        : simulator_(simulator),
          model_(model),
          records_(simulator),
          all_(all),
          episodes_(static_cast<std::size_t>(environments)),
          values_(static_cast<std::size_t>(environments) *
                  static_cast<std::size_t>(model.observations.column_count())),
          features_(static_cast<std::size_t>(environments) *
                    static_cast<std::size_t>(model.features())) {}

    void before_step(const rddl_batch& batch) override {
        require_done(simulator_,
                     simulator_.get_observation_values(&batch, RDDL_FLOAT, values_.data()));
    }
    void after_step(const rddl_batch& /*batch*/) override {}
    void add(std::size_t i, std::int64_t /*episode*/, std::int64_t step, const std::byte* action,
             double reward, std::uint8_t causes) override {
        if (causes & RDDL_FAULTED) return;
        const auto width = static_cast<std::size_t>(model_.features());
        const auto columns = static_cast<std::size_t>(model_.observations.column_count());
        const auto count = static_cast<std::size_t>(model_.actions.column_count);
        float* const features = features_.data() + i * width;
        write_features(model_.observations, values_.data() + i * columns, step, step == 0,
                       features);
        Demonstrations& own = episodes_[i];
        own.features.insert(own.features.end(), features, features + width);
        own.actions.resize(own.actions.size() + count);
        records_.read(action, own.actions.data() + own.actions.size() - count);
        own.rewards.push_back(reward);
        own.is_last.push_back(0);
    }
    void finish() override {
        const auto append = [](auto& to, const auto& from) {
            to.insert(to.end(), from.begin(), from.end());
        };
        for (Demonstrations& own : episodes_) {
            if (own.count() == 0) continue;
            own.is_last.back() = 1;
            append(all_.features, own.features);
            append(all_.actions, own.actions);
            append(all_.rewards, own.rewards);
            append(all_.is_last, own.is_last);
        }
    }

  private:
    const rddl_simulator& simulator_;
    const PpoModel& model_;
    ActionRecords records_;
    Demonstrations& all_;
    std::vector<Demonstrations> episodes_;  // by the place in the batch
    std::vector<float> values_, features_;
};

}  // namespace

Demonstrations demonstrations(const rddl_simulator& simulator, const PpoModel& model,
                              const Policy& policy, const EpisodeOptions& options, Watch watch) {
    Demonstrations all;
    watch.record = [&](std::int64_t environments) {
        return std::make_unique<DemonstrationRecorder>(simulator, model, environments, all);
    };
    const Rollouts rollouts = run_episodes(simulator, policy, options, watch);
    if (watch.stops && watch.stops())
        throw Failure("interrupted while it was shown what to imitate");
    for (const double reward : all.rewards)
        if (!std::isfinite(reward))
            throw Failure(
                fmt::format("'{}' cannot be imitated: a reward is {}", policy.name, reward));
    if (all.count() == 0)
        throw Failure(
            fmt::format("'{}' cannot be imitated: its episodes have no steps", policy.name));
    all.returns = summary_of(rollouts).undiscounted_return;
    return all;
}

}  // namespace rddlc::solvers
