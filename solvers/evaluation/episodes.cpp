#include "solvers/evaluation/episodes.hpp"

#include "solvers/batches/batch.hpp"
#include "solvers/evaluation/threads.hpp"

#include <rddl/random/random.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace rddlc::solvers {

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
    // After a failure no thread may wait for a turn that never comes.
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

rddl_batch_options batch_options(const EpisodeOptions& options, std::int64_t first,
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
    EpisodeBatch(const rddl_simulator& simulator, const EpisodeOptions& options,
                 const Policy& policy, std::int64_t first, std::int64_t count)
        : simulator_(simulator),
          problem_(*simulator.problem),
          options_(options),
          first_(first),
          batch_(create_batch(simulator, batch_options(options, first, count))),
          episodes_(static_cast<std::size_t>(count)),
          discounts_(episodes_.size(), 1.0),
          rewards_(episodes_.size()),
          causes_(episodes_.size()),
          running_(episodes_.size()),
          numbers_(episodes_.size()),
          steps_(episodes_.size()),
          violated_(episodes_.size(), -1),
          actor_(policy.start(count)),
          action_size_(static_cast<std::size_t>(problem_.action_size)),
          actions_(episodes_.size() * action_size_) {
        for (std::size_t i = 0; i < episodes_.size(); ++i) {
            set_default_action(i);
            numbers_[i] = number_of(i);
        }
        require_done(simulator_, simulator_.get_causes(batch_.get(), 0, count, causes_.data()));
        for (std::size_t i = 0; i < episodes_.size(); ++i)
            if (causes_[i] != RDDL_RUNNING) end_episode(i);
    }

    bool running() const {
        return std::any_of(episodes_.begin(), episodes_.end(),
                           [](const Episode& episode) { return !episode.finished; });
    }

    // Chooses the actions of the next step; those that violate a precondition are treated as the
    // options say.
    void choose_actions(const Stops& stops) {
        for (std::size_t i = 0; i < episodes_.size(); ++i) {
            running_[i] = !episodes_[i].finished;
            steps_[i] = episodes_[i].length;
        }
        Decision decision{batch_.get(), running_,        numbers_,
                          steps_,       actions_.data(), violated_,
                          false,        &stops,          batch_options(options_, 0, 0).horizon};
        actor_(decision);
        // If a policy block faults, the episode is over, and the action does not matter.
        require_done(simulator_, simulator_.get_causes(batch_.get(), 0,
                                                       static_cast<std::int64_t>(causes_.size()),
                                                       causes_.data()));
        if (problem_.precondition_count == 0) return;
        if (!decision.knows_violated && options_.preconditions != Preconditions::Ignore)
            require_done(simulator_, simulator_.violated_preconditions(
                                         batch_.get(), actions_.data(), violated_.data()));
        for (std::size_t i = 0; i < episodes_.size(); ++i)
            if (is_illegal(i)) treat_illegal_action(i);
    }

    void step() {
        rddl_transition out{};
        out.rewards = rewards_.data();
        out.causes = causes_.data();
        require_done(simulator_, simulator_.step(batch_.get(), actions_.data(), &out));
        for (std::size_t i = 0; i < episodes_.size(); ++i)
            if (!episodes_[i].finished) record(i);
    }

    // The same, and writes it down.
    void step(Recorder& recorder) {
        const std::vector<Episode> before = episodes_;
        recorder.before_step(*batch_);
        step();
        recorder.after_step(*batch_);
        for (std::size_t i = 0; i < episodes_.size(); ++i)
            if (!before[i].finished)
                recorder.add(i, number_of(i), before[i].length, action(i), rewards_[i], causes_[i]);
    }

    const std::vector<Episode>& episodes() const { return episodes_; }

    // The fault of the lowest episode number, as are the next two.
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

    // Whether the action is known to be illegal.
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

    // Keeps the present situation of environment i, unless an episode of a lower number is there.
    void note(std::optional<EpisodeViolation>& first, std::size_t i) {
        const std::int64_t episode = number_of(i), step = episodes_[i].length;
        if (first && first->episode <= episode) return;
        Violation violation;
        violation.state.resize(static_cast<std::size_t>(problem_.state_size));
        require_done(simulator_, simulator_.get_state(batch_.get(), static_cast<std::int64_t>(i), 1,
                                                      violation.state.data()));
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
        if (!std::isfinite(rewards_[i]) && episode.not_finite_step < 0)
            episode.not_finite_step = episode.length;
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
    const EpisodeOptions& options_;
    std::int64_t first_;
    BatchHandle batch_;
    std::vector<Episode> episodes_;
    std::vector<double> discounts_;
    std::vector<double> rewards_;
    std::vector<std::uint8_t> causes_;
    std::vector<std::uint8_t> running_;
    std::vector<std::int64_t> numbers_, steps_;
    std::vector<std::int32_t> violated_;  // the precondition, by the action chosen last; or -1
    Actor actor_;
    std::size_t action_size_;
    std::vector<std::byte> actions_;
    std::optional<EpisodeViolation> first_illegal_action_, first_broken_invariant_;
};

// All threads' share of the work.
class Rollout {
  public:
    Rollout(const rddl_simulator& simulator, const Policy& policy, const EpisodeOptions& options,
            const Watch& watch)
        : simulator_(simulator),
          policy_(policy),
          options_(options),
          watch_(watch),
          steps_at_most_(steps_at_most(simulator, options)),
          episodes_(static_cast<std::size_t>(options.episodes)) {}

    void work() {
        try {
            for (std::int64_t number = next_batch_++; number * options_.batch < options_.episodes;
                 number = next_batch_++) {
                if (stops()) break;
                run_batch(number);
            }
        } catch (...) {
            const std::scoped_lock lock(result_mutex_);
            if (!failure_) failure_ = std::current_exception();
            next_batch_ = options_.episodes;  // the other threads also stop
        }
        // Only an early end leaves batches that others could wait for.
        if (stops() || has_failed()) turns_.abandon();
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

    bool stops() const { return watch_.stops && watch_.stops(); }
    void advance(std::int64_t steps) const {
        if (watch_.advance) watch_.advance(steps);
    }

    void run_batch(std::int64_t number) {
        const std::int64_t first = number * options_.batch;
        const std::int64_t count = std::min(options_.batch, options_.episodes - first);
        EpisodeBatch batch(simulator_, options_, policy_, first, count);
        const std::unique_ptr<Recorder> recorder = watch_.record ? watch_.record(count) : nullptr;
        std::int64_t steps = 0;
        for (; batch.running() && !stops(); ++steps) {
            batch.choose_actions(watch_.stops);
            if (stops()) break;  // they need not be chosen to the end
            recorder ? batch.step(*recorder) : batch.step();
            if (steps_at_most_ > 0) advance(count);
        }
        if (recorder) finish(number, *recorder);
        std::copy(batch.episodes().begin(), batch.episodes().end(), episodes_.begin() + first);
        note_firsts(batch);
        // Counts the steps that episodes saved by ending early; all of them if there is no horizon.
        advance(steps_at_most_ > 0 ? count * (steps_at_most_ - steps) : count);
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

    void finish(std::int64_t number, Recorder& recorder) {
        if (!turns_.wait_for(number)) return;
        recorder.finish();
        turns_.end(number);
    }

    const rddl_simulator& simulator_;
    const Policy& policy_;
    const EpisodeOptions& options_;
    const Watch& watch_;
    std::int64_t steps_at_most_;
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

// Enough environments to amortise a call, and few enough to give every thread work. One by one they
// are with a trace, so that few lines wait for their turn, and where a batch makes no call cheaper.
std::int64_t batch_size(const EpisodeOptions& options, const rddl_simulator& simulator, int threads,
                        bool one_by_one) {
    const std::int64_t bytes = bytes_per_environment(simulator) * threads;
    const std::int64_t most = std::max<std::int64_t>(options.memory_limit / bytes, 1);
    const std::int64_t chosen =
        options.batch > 0 ? std::min(options.batch, options.episodes)
        : one_by_one      ? 1
                     : std::min(std::clamp<std::int64_t>(options.episodes / threads, 1, 64), most);
    require_memory(simulator, chosen * threads, options.memory_limit);
    return options.batch > 0 ? options.batch : chosen;
}

}  // namespace

// More than that no progress bar counts.
std::int64_t steps_at_most(const rddl_simulator& simulator, const EpisodeOptions& options) {
    const std::int64_t horizon = options.horizon.value_or(simulator.problem->horizon);
    return horizon <= 1'000'000'000 ? horizon : 0;
}

Rollouts run_episodes(const rddl_simulator& simulator, const Policy& policy,
                      const EpisodeOptions& options, const Watch& watch) {
    require_spaces(policy, simulator);
    Rollouts rollouts;
    EpisodeOptions chosen = options;
    rollouts.threads =
        static_cast<int>(std::min<std::int64_t>(thread_count(options.threads), options.episodes));
    chosen.batch = batch_size(options, simulator, rollouts.threads,
                              static_cast<bool>(watch.record) || policy.decides_one_by_one);

    const auto begin = std::chrono::steady_clock::now();
    Rollout rollout(simulator, policy, chosen, watch);
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

}  // namespace rddlc::solvers
