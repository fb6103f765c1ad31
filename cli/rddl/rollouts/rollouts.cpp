#include "rollouts/rollouts.hpp"

#include "engines/batch.hpp"
#include "engines/faults.hpp"
#include "formats/trace.hpp"
#include "rollouts/parallel.hpp"
#include "rollouts/random_actions.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/progress.hpp"

#include <rddl/random.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace rddlc::cli {

namespace {

// Lets the threads that finish batches out of order write their traces in order.
class Turns {
  public:
    // False: the turn will never come.
    bool wait_for(std::int64_t number) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return next_ == number || abandoned_; });
        return next_ == number;
    }
    void end(std::int64_t number) {
        const std::scoped_lock lock(mutex_);
        next_ = number + 1;
        changed_.notify_all();
    }
    // After a failure nobody may wait for the turn that never comes.
    void abandon() {
        const std::scoped_lock lock(mutex_);
        abandoned_ = true;
        changed_.notify_all();
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::int64_t next_ = 0;
    bool abandoned_ = false;
};

rddl_batch_options batch_options(const RolloutOptions& options, std::int64_t first,
                                 std::int64_t count) {
    rddl_batch_options batch{};
    batch.environment_count = count;
    batch.first_environment = first;
    batch.seed = options.seed;
    batch.thread_count = 1;
    if (options.horizon) batch.horizon = horizon_option(*options.horizon);
    return batch;
}

// Consecutive episodes stepped together by one thread.
class EpisodeBatch {
  public:
    EpisodeBatch(const rddl_simulator& simulator, const RolloutOptions& options,
                 RandomPolicy& policy, std::int64_t first, std::int64_t count)
        : simulator_(simulator),
          problem_(*simulator.problem),
          options_(options),
          first_(first),
          batch_(create_batch(simulator, batch_options(options, first, count))),
          episodes_(static_cast<std::size_t>(count)),
          discounts_(episodes_.size(), 1.0),
          rewards_(episodes_.size()),
          causes_(episodes_.size()),
          violated_(episodes_.size(), -1),
          random_actions_(simulator, policy, count),
          action_size_(static_cast<std::size_t>(problem_.action_size)),
          actions_(episodes_.size() * action_size_) {
        for (std::size_t i = 0; i < episodes_.size(); ++i) set_default_action(i);
        simulator_.get_causes(batch_.get(), 0, count, causes_.data());
        for (std::size_t i = 0; i < episodes_.size(); ++i)
            if (causes_[i] != RDDL_RUNNING) end_episode(i);
    }

    bool running() const {
        return std::any_of(episodes_.begin(), episodes_.end(),
                           [](const Episode& episode) { return !episode.finished; });
    }

    // Of the next step; those that violate a precondition are treated as the options say.
    void choose_actions() {
        const bool random = options_.policy == Policy::Random;
        if (random) draw_actions();
        if (options_.policy == Policy::Rddl) ask_policy_block();
        if (problem_.precondition_count == 0) return;
        if (!random && options_.preconditions != Preconditions::Ignore) ask_preconditions();
        for (std::size_t i = 0; i < episodes_.size(); ++i)
            if (is_illegal(i)) treat_illegal_action(i);
    }

    void step() {
        rddl_transition out{};
        out.rewards = rewards_.data();
        out.causes = causes_.data();
        simulator_.step(batch_.get(), actions_.data(), &out);
        for (std::size_t i = 0; i < episodes_.size(); ++i)
            if (!episodes_[i].finished) record(i);
    }

    // The same, with a trace line for each environment that was running.
    void step(TraceLines& lines) {
        const std::vector<Episode> before = episodes_;
        lines.before_step(*batch_);
        step();
        lines.after_step(*batch_);
        for (std::size_t i = 0; i < episodes_.size(); ++i)
            if (!before[i].finished)
                lines.add(i, number_of(i), before[i].length, action(i), rewards_[i], causes_[i]);
    }

    const std::vector<Episode>& episodes() const { return episodes_; }

    // Of the lowest number, as are the next two.
    std::optional<EpisodeFault> first_fault() const {
        for (std::size_t i = 0; i < episodes_.size(); ++i) {
            if (!(episodes_[i].causes & RDDL_FAULTED)) continue;
            return EpisodeFault{number_of(i), episodes_[i].length,
                                fault_text(simulator_, *batch_, static_cast<std::int64_t>(i))};
        }
        return std::nullopt;
    }
    const std::optional<EpisodeViolation>& first_illegal_action() const {
        return first_illegal_action_;
    }
    const std::optional<EpisodeViolation>& first_broken_invariant() const {
        return first_broken_invariant_;
    }

  private:
    std::int64_t number_of(std::size_t i) const { return first_ + static_cast<std::int64_t>(i); }
    std::byte* action(std::size_t i) { return actions_.data() + i * action_size_; }

    void set_default_action(std::size_t i) {
        std::copy_n(static_cast<const std::byte*>(problem_.default_action), action_size_,
                    action(i));
    }

    void draw_actions() {
        random_actions_.draw(
            batch_.get(), actions_.data(), [&](std::size_t i) { return !episodes_[i].finished; },
            [&](std::size_t i) { return number_of(i); },
            [&](std::size_t i) { return episodes_[i].length; });
        for (std::size_t i = 0; i < episodes_.size(); ++i)
            violated_[i] = random_actions_.violated(i);
    }

    // Where it faults, the episode is over, and the action does not matter.
    void ask_policy_block() {
        simulator_.policy_act(batch_.get(), actions_.data());
        simulator_.get_causes(batch_.get(), 0, static_cast<std::int64_t>(causes_.size()),
                              causes_.data());
    }

    void ask_preconditions() {
        simulator_.violated_preconditions(batch_.get(), actions_.data(), violated_.data());
    }

    // As far as it was asked.
    bool is_illegal(std::size_t i) const {
        return !episodes_[i].finished && causes_[i] == RDDL_RUNNING && violated_[i] >= 0;
    }

    void treat_illegal_action(std::size_t i) {
        Episode& episode = episodes_[i];
        ++episode.illegal_actions;
        if (options_.preconditions != Preconditions::Ignore) note(first_illegal_action_, i);
        if (options_.preconditions == Preconditions::Error) {
            episode.finished = true;
            episode.refused = true;
        } else if (options_.preconditions == Preconditions::Noop) {
            set_default_action(i);
        }
    }

    // Keeps what is going on in environment i, unless an episode of a lower number is there.
    void note(std::optional<EpisodeViolation>& first, std::size_t i) {
        const std::int64_t episode = number_of(i), step = episodes_[i].length;
        if (first && first->episode <= episode) return;
        Violation violation;
        violation.state.resize(static_cast<std::size_t>(problem_.state_size));
        simulator_.get_state(batch_.get(), static_cast<std::int64_t>(i), 1, violation.state.data());
        violation.action.assign(action(i), action(i) + action_size_);
        violation.context.key =
            rddl::stream_key(options_.seed, static_cast<std::uint64_t>(episode), 0);
        violation.context.step = static_cast<std::uint32_t>(step + 1);
        first = EpisodeViolation{episode, step, std::move(violation)};
    }

    void record(std::size_t i) {
        Episode& episode = episodes_[i];
        if (causes_[i] != RDDL_RUNNING) end_episode(i);
        if (causes_[i] & RDDL_TRUNCATED_INVARIANT) note(first_broken_invariant_, i);
        if (causes_[i] & RDDL_FAULTED) return;  // a step that faults is not made
        episode.length += 1;
        episode.undiscounted_return += rewards_[i];
        episode.discounted_return += discounts_[i] * rewards_[i];
        discounts_[i] *= problem_.discount;
    }

    void end_episode(std::size_t i) {
        episodes_[i].finished = true;
        episodes_[i].causes = causes_[i];
    }

    const rddl_simulator& simulator_;
    const rddl_problem& problem_;
    const RolloutOptions& options_;
    std::int64_t first_;
    Batch batch_;
    std::vector<Episode> episodes_;
    std::vector<double> discounts_;
    std::vector<double> rewards_;
    std::vector<std::uint8_t> causes_;
    std::vector<std::int32_t> violated_;  // the precondition, by the action chosen last; or -1
    RandomActions random_actions_;
    std::size_t action_size_;
    std::vector<std::byte> actions_;
    std::optional<EpisodeViolation> first_illegal_action_, first_broken_invariant_;
};

// For the progress bar: how many steps an episode has at most; 0: nobody knows, or too many.
std::int64_t steps_per_episode(const rddl_simulator& simulator, const RolloutOptions& options) {
    const std::int64_t horizon = options.horizon.value_or(simulator.problem->horizon);
    return horizon <= 1'000'000'000 ? horizon : 0;
}

// All threads' share of the work.
class Rollout {
  public:
    Rollout(const rddl_simulator& simulator, const RolloutOptions& options, const TraceSink& trace,
            bool progress)
        : simulator_(simulator),
          options_(options),
          trace_(trace),
          steps_per_episode_(steps_per_episode(simulator, options)),
          progress_("running", options.episodes * std::max<std::int64_t>(steps_per_episode_, 1),
                    progress),
          trace_format_(trace ? std::optional<TraceFormat>(*simulator.problem) : std::nullopt),
          episodes_(static_cast<std::size_t>(options.episodes)) {}

    void work() {
        try {
            RandomPolicy policy(*simulator_.problem, options_.seed);
            for (std::int64_t number = next_batch_++; number * options_.batch < options_.episodes;
                 number = next_batch_++) {
                if (is_interrupted()) break;
                run_batch(number, policy);
            }
        } catch (...) {
            const std::scoped_lock lock(result_mutex_);
            if (!failure_) failure_ = std::current_exception();
            next_batch_ = options_.episodes;  // the other threads stop, too
        }
        // Only an early end leaves batches that others could wait for.
        if (is_interrupted() || has_failed()) turns_.abandon();
    }

    void take_results(Rollouts& rollouts) {
        if (failure_) std::rethrow_exception(failure_);
        rollouts.episodes = std::move(episodes_);
        rollouts.first_fault = std::move(first_fault_);
        rollouts.first_illegal_action = std::move(first_illegal_action_);
        rollouts.first_broken_invariant = std::move(first_broken_invariant_);
    }

  private:
    bool has_failed() {
        const std::scoped_lock lock(result_mutex_);
        return failure_ != nullptr;
    }

    void run_batch(std::int64_t number, RandomPolicy& policy) {
        const std::int64_t first = number * options_.batch;
        const std::int64_t count = std::min(options_.batch, options_.episodes - first);
        EpisodeBatch batch(simulator_, options_, policy, first, count);
        std::optional<TraceLines> lines;
        if (trace_format_) lines.emplace(simulator_, *trace_format_, count);
        std::int64_t steps = 0;
        for (; batch.running() && !is_interrupted(); ++steps) {
            batch.choose_actions();
            lines ? batch.step(*lines) : batch.step();
            if (steps_per_episode_ > 0) progress_.advance(count);
        }
        if (lines) write_trace(number, *lines);
        std::copy(batch.episodes().begin(), batch.episodes().end(), episodes_.begin() + first);
        note_firsts(batch);
        // What episodes that ended early have saved; all of it if there is no horizon.
        progress_.advance(steps_per_episode_ > 0 ? count * (steps_per_episode_ - steps) : count);
    }

    void note_firsts(const EpisodeBatch& batch) {
        const std::scoped_lock lock(result_mutex_);
        const auto keep_lower = [](auto& first, const auto& other) {
            if (other && (!first || other->episode < first->episode)) first = other;
        };
        keep_lower(first_fault_, batch.first_fault());
        keep_lower(first_illegal_action_, batch.first_illegal_action());
        keep_lower(first_broken_invariant_, batch.first_broken_invariant());
    }

    void write_trace(std::int64_t number, const TraceLines& lines) {
        if (!turns_.wait_for(number)) return;
        trace_(lines.text());
        turns_.end(number);
    }

    const rddl_simulator& simulator_;
    const RolloutOptions& options_;
    const TraceSink& trace_;
    std::int64_t steps_per_episode_;  // at most; 0: nobody knows
    Progress progress_;
    std::optional<TraceFormat> trace_format_;
    std::vector<Episode> episodes_;
    std::atomic<std::int64_t> next_batch_ = 0;
    Turns turns_;
    std::mutex result_mutex_;  // of all that follow
    std::optional<EpisodeFault> first_fault_;
    std::optional<EpisodeViolation> first_illegal_action_, first_broken_invariant_;
    std::exception_ptr failure_;
};

int thread_count(int wanted) {
    if (wanted > 0) return wanted;
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// Enough environments to amortise a call, few enough to give every thread work and, with a trace,
// to keep the lines that wait for their turn small.
std::int64_t batch_size(const RolloutOptions& options, const rddl_simulator& simulator, int threads,
                        bool traced) {
    const std::int64_t bytes = bytes_per_environment(simulator) * threads;
    const std::int64_t most = std::max<std::int64_t>(options.memory_limit / bytes, 1);
    const std::int64_t chosen =
        options.batch > 0 ? std::min(options.batch, options.episodes)
        : traced          ? 1
                 : std::min(std::clamp<std::int64_t>(options.episodes / threads, 1, 64), most);
    require_room(simulator, chosen * threads, options.memory_limit);
    return options.batch > 0 ? options.batch : chosen;
}

}  // namespace

std::string_view name_of(Policy policy) {
    switch (policy) {
        case Policy::Random:
            return "random";
        case Policy::Noop:
            return "noop";
        case Policy::Rddl:
            break;
    }
    return "rddl";
}

Rollouts run_episodes(const rddl_simulator& simulator, const RolloutOptions& options,
                      const TraceSink& trace, bool progress) {
    Rollouts rollouts;
    RolloutOptions chosen = options;
    rollouts.threads =
        static_cast<int>(std::min<std::int64_t>(thread_count(options.threads), options.episodes));
    chosen.batch = batch_size(options, simulator, rollouts.threads, static_cast<bool>(trace));

    const auto begin = std::chrono::steady_clock::now();
    Rollout rollout(simulator, chosen, trace, progress);
    std::vector<std::thread> others = start_threads(rollouts.threads - 1, [&] { rollout.work(); });
    rollouts.missing_threads = rollouts.threads - 1 - static_cast<int>(others.size());
    rollouts.threads -= rollouts.missing_threads;
    rollout.work();
    for (std::thread& thread : others) thread.join();
    rollouts.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

    rollout.take_results(rollouts);
    for (const Episode& episode : rollouts.episodes) rollouts.steps += episode.length;
    return rollouts;
}

}  // namespace rddlc::cli
