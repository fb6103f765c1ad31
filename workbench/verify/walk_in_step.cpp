#include "verify/walk_in_step.hpp"

#include "solvers/policies/random_actions.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/progress.hpp"

#include <algorithm>
#include <random>

namespace rddlc::workbench {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int most_idle_rounds = 5;
constexpr std::int64_t most_sample_bytes = 64 << 20;

class Walker {
  public:
    Walker(const std::vector<VerifiedEngine>& engines, const OutcomeComparison& comparison,
           const WalkOptions& options)
        : engines_(engines),
          comparison_(comparison),
          options_(options),
          problem_(*engines.front().simulator->problem),
          random_policy_(problem_, options.seed),
          quickest_(quickest(engines)),
          random_actions_(*engines[quickest_].simulator, random_policy_, options.environments),
          random_states_(comparison.state(), options.seed),
          sample_choice_(options.seed),
          progress_("comparing", goal(), options.progress) {
        for (const VerifiedEngine& engine : engines)
            environments_.emplace_back(engine, options.environments, options.seed, 0);
        const std::int64_t bytes = 2 * problem_.state_size + problem_.action_size + 1;
        most_samples_ = std::min<std::size_t>(
            options.most_samples, static_cast<std::size_t>(most_sample_bytes / bytes) + 1);
    }

    Walk run() {
        compare_starts(std::vector<std::uint8_t>(count(), 1));
        int idle = 0;
        while (!walk_.disagreement && is_wanted() && idle < most_idle_rounds) {
            const std::int64_t before = walk_.steps;
            make_round();
            idle = walk_.steps == before ? idle + 1 : 0;
            progress_.advance(walk_.steps - before);
        }
        walk_.interrupted = is_interrupted();
        return std::move(walk_);
    }

  private:
    std::size_t count() const { return static_cast<std::size_t>(options_.environments); }
    VerifiedEnvironments& reference() { return environments_.front(); }
    std::int64_t goal() const {
        return options_.recorded.empty() ? options_.steps
                                         : static_cast<std::int64_t>(options_.recorded.size());
    }

    bool is_wanted() const {
        if (is_interrupted()) return false;
        if (walk_.steps > 0 && Clock::now() >= options_.end) return false;
        if (options_.recorded.empty()) return walk_.steps < options_.steps;
        return next_recorded_ < options_.recorded.size();
    }

    void make_round() {
        place_states();
        starts_.clear();
        for (std::size_t i = 0; i < count(); ++i) starts_.push_back(start_of(i));
        choose_actions();
        std::vector<std::vector<StepOutcome>> outcomes;
        for (VerifiedEnvironments& environments : environments_)
            outcomes.push_back(environments.step(actions_));
        for (std::size_t i = 0; i < count(); ++i) compare_step(outcomes, i);
        start_next_episodes(outcomes.front());
        ++rounds_;
    }

    // ------------------------------------------------------------------------- where they start

    // The states of this round; all engines have the same, even where they rounded differently.
    void place_states() {
        recorded_action_.assign(count(), nullptr);
        placed_.assign(count(), 0);
        for (std::size_t i = 0; i < count(); ++i) {
            const auto environment = static_cast<std::int64_t>(i);
            Record state = reference().state(environment);
            if (!options_.recorded.empty())
                take_recorded(i, state);
            else if (i % 2 == 1 && !state.empty())
                shake(i, state);
            for (VerifiedEnvironments& environments : environments_)
                if (placed_[i] || environments.state(environment) != state)
                    environments.set_state(environment, state);
        }
    }

    void take_recorded(std::size_t i, Record& state) {
        if (next_recorded_ == options_.recorded.size()) return;
        const RecordedState& recorded = options_.recorded[next_recorded_++];
        state = recorded.state;
        if (recorded.action) recorded_action_[i] = &*recorded.action;
        placed_[i] = 1;
        ++walk_.recorded_states;
    }

    void shake(std::size_t i, Record& state) {
        random_states_.shake(state);
        placed_[i] = 1;
        ++walk_.random_states;
    }

    StepStart start_of(std::size_t i) {
        const auto environment = static_cast<std::int64_t>(i);
        StepStart start;
        start.state = reference().state(environment);
        start.environment = environment;
        start.episode = reference().episodes(environment);
        start.step = reference().steps(environment);
        return start;
    }

    // ------------------------------------------------------------------------------ what they do

    void choose_actions() {
        switch (options_.policy) {
            case Policy::Random:
                draw_actions();
                break;
            case Policy::Noop:
                leave_defaults();
                break;
            case Policy::Learned:  // takes no part in comparisons
            case Policy::Planner:
            case Policy::Rddl:
                ask_policies();
                break;
        }
        const auto size = static_cast<std::size_t>(problem_.action_size);
        for (std::size_t i = 0; i < count(); ++i) {
            std::byte* const action = actions_.data() + i * size;
            if (recorded_action_[i]) std::copy_n(recorded_action_[i]->data(), size, action);
            starts_[i].action.assign(action, action + size);
        }
    }

    void leave_defaults() {
        const auto* const defaults = static_cast<const std::byte*>(problem_.default_action);
        actions_.clear();
        for (std::size_t i = 0; i < count(); ++i)
            actions_.insert(actions_.end(), defaults, defaults + problem_.action_size);
        if (actions_.empty()) actions_.resize(1);
    }

    void ask_policies() {
        seen_.resize(count());
        for (std::size_t i = 0; i < count(); ++i) {
            if (starts_[i].step == 0) seen_[i].clear();
            const auto environment = static_cast<std::int64_t>(i);
            seen_[i].push_back(problem_.partially_observed ? reference().observation(environment)
                                                           : starts_[i].state);
            starts_[i].seen = seen_[i];
        }
        for (std::size_t e = environments_.size(); e-- > 0;) actions_ = environments_[e].act();
    }

    void draw_actions() {
        const auto size = static_cast<std::size_t>(problem_.action_size);
        actions_.resize(std::max<std::size_t>(count() * size, 1));
        // Every episode has a random policy of its own.
        const auto identity = [&](std::size_t i) {
            return starts_[i].environment + starts_[i].episode * options_.environments;
        };
        const auto step = [&](std::size_t i) {
            return starts_[i].step;
        };
        if (rounds_ % 4 == 3) {
            for (std::size_t i = 0; i < count(); ++i)
                random_policy_.act(identity(i), step(i), actions_.data() + i * size);
            return;
        }
        random_actions_.draw(
            environments_[quickest_].batch(), actions_.data(), [](std::size_t) { return true; },
            identity, step);
    }

    // Whether actions are legal is asked of the last engine, since the search for one takes long in
    // the interpreter. Its answer about the action in the end is compared as all else.
    static std::size_t quickest(const std::vector<VerifiedEngine>& engines) {
        for (std::size_t e = engines.size(); e-- > 1;)
            if (!engines[e].one_by_one) return e;
        return 0;
    }

    // --------------------------------------------------------------------------- what they show

    void compare_step(const std::vector<std::vector<StepOutcome>>& outcomes, std::size_t i) {
        const StepOutcome& shown = outcomes.front()[i];
        const bool ran = shown.causes_before == RDDL_RUNNING;
        if (!ran && !placed_[i]) return;
        if (!agree(outcomes, i, starts_[i])) return;
        comparison_.count(shown, walk_.counts);
        if (!ran) return;
        ++walk_.steps;
        if (shown.fault.empty() && !placed_[i]) random_states_.see(shown.state);
        if (!placed_[i] || recorded_action_[i] || !options_.recorded.empty()) sample(i, shown);
    }

    bool agree(const std::vector<std::vector<StepOutcome>>& outcomes, std::size_t i,
               const StepStart& start) {
        for (std::size_t e = 1; e < engines_.size() && !walk_.disagreement; ++e) {
            const VerifiedEngine& engine = engines_[e];
            if (auto difference = comparison_.compare(outcomes[engine.reference][i], outcomes[e][i],
                                                      engine.tolerance, walk_.counts))
                walk_.disagreement = Disagreement{e, *std::move(difference), start};
        }
        return !walk_.disagreement;
    }

    // Each step is kept with the same probability.
    void sample(std::size_t i, const StepOutcome& outcome) {
        ++candidates_;
        if (walk_.samples.size() < most_samples_) {
            walk_.samples.push_back({starts_[i], outcome});
        } else if (most_samples_ > 0) {
            const std::uint64_t place = sample_choice_() % candidates_;
            if (place < most_samples_) walk_.samples[place] = {starts_[i], outcome};
        }
    }

    void start_next_episodes(const std::vector<StepOutcome>& shown) {
        std::vector<std::uint8_t> over(count(), 0);
        for (std::size_t i = 0; i < count(); ++i)
            over[i] = shown[i].causes_before != RDDL_RUNNING || shown[i].causes != RDDL_RUNNING;
        if (walk_.disagreement || std::ranges::count(over, 0) == std::ssize(over)) return;
        for (VerifiedEnvironments& environments : environments_) environments.restart(over);
        compare_starts(over);
    }

    // The initial states, which may be random.
    void compare_starts(const std::vector<std::uint8_t>& mask) {
        std::vector<std::vector<StepOutcome>> outcomes;
        for (const VerifiedEnvironments& environments : environments_)
            outcomes.push_back(environments.look());
        for (std::size_t i = 0; i < count(); ++i) {
            if (!mask[i] || walk_.disagreement) continue;
            StepStart start = start_of(i);
            start.initial = true;
            if (!agree(outcomes, i, start)) return;
            random_states_.see(outcomes.front()[i].state);
            ++walk_.episodes;
        }
    }

    const std::vector<VerifiedEngine>& engines_;
    const OutcomeComparison& comparison_;
    const WalkOptions& options_;
    const rddl_problem& problem_;
    std::vector<VerifiedEnvironments> environments_;  // by engine
    solvers::RandomPolicy random_policy_;
    std::size_t quickest_;
    solvers::RandomActions random_actions_;
    RandomStates random_states_;
    std::mt19937_64 sample_choice_;
    std::uint64_t candidates_ = 0;
    std::size_t most_samples_ = 0;
    Progress progress_;
    Walk walk_;
    std::int64_t rounds_ = 0;
    std::size_t next_recorded_ = 0;

    // The steps of this round, by environment.
    std::vector<StepStart> starts_;
    std::vector<std::uint8_t> placed_;
    std::vector<const Record*> recorded_action_;
    std::vector<std::byte> actions_;
    std::vector<std::vector<Record>> seen_;  // by the policy, in this episode
};

}  // namespace

Walk walk_in_step(const std::vector<VerifiedEngine>& engines, const OutcomeComparison& comparison,
                  const WalkOptions& options) {
    return Walker(engines, comparison, options).run();
}

}  // namespace rddlc::workbench
