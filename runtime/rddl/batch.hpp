// Many environments of one simulator, stepped together.
//
// Each environment has its own state record and episode; nothing is shared between them, so a
// trajectory does not depend on the batch around it or on the threads. Nothing is allocated after
// construction.
#pragma once

#include <rddl/action_choices.hpp>
#include <rddl/engine.hpp>
#include <rddl/episode.hpp>
#include <rddl/policy.hpp>
#include <rddl/simulator.h>
#include <rddl/threads.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <span>
#include <vector>

namespace rddl {

// Zeroed records of one size, one after the other, beginning at a cache line of their own.
class Records {
  public:
    Records(std::size_t count, std::size_t size) : size_(size), lines_(lines(count, size)) {}

    std::byte* operator[](std::int64_t i) {
        return reinterpret_cast<std::byte*>(lines_.data()) + offset(i);
    }
    const std::byte* operator[](std::int64_t i) const {
        return reinterpret_cast<const std::byte*>(lines_.data()) + offset(i);
    }

  private:
    struct alignas(64) Line {
        std::byte bytes[64]{};
    };

    // At least one, so that empty records have an address too.
    static std::size_t lines(std::size_t count, std::size_t size) {
        if (size > 0 && count > std::numeric_limits<std::size_t>::max() / 2 / size)
            throw std::bad_alloc();
        return count * size / sizeof(Line) + 1;
    }
    std::size_t offset(std::int64_t i) const { return static_cast<std::size_t>(i) * size_; }

    std::size_t size_;
    std::vector<Line> lines_;
};

// How a batch is made, checked and with all defaults resolved.
struct BatchOptions {
    std::int64_t environment_count = 1;
    std::int64_t first_environment = 0;
    std::uint64_t seed = 0;
    int thread_count = 1;
    rddl_autoreset autoreset = RDDL_AUTORESET_DISABLED;
    std::int64_t horizon = 0;  // 0: none
    bool partially_observed = false;
};

// The engine must outlive the batch.
template <Engine E>
class Batch {
  public:
    // Every environment starts its first episode. Throws std::bad_alloc.
    Batch(const E& engine, const BatchOptions& options)
        : engine_(&engine),
          options_(options),
          states_(count(), engine.state_size()),
          observations_(options.partially_observed ? count() : 0, engine.observation_size()),
          memories_(has_policy(engine) ? count() : 0, memory_size(engine)),
          episodes_(count()),
          workspaces_(static_cast<std::size_t>(options.thread_count), Workspace(engine)),
          team_(options.thread_count) {
        reset(nullptr, nullptr);
    }
    Batch(const Batch& other)
        : engine_(other.engine_),
          options_(other.options_),
          states_(other.states_),
          observations_(other.observations_),
          memories_(other.memories_),
          episodes_(other.episodes_),
          workspaces_(other.workspaces_),
          team_(other.options_.thread_count) {}
    Batch& operator=(const Batch&) = delete;

    std::int64_t environment_count() const { return options_.environment_count; }
    const Episode& episode(std::int64_t i) const { return episodes_[static_cast<std::size_t>(i)]; }
    const std::byte* state(std::int64_t i) const { return states_[i]; }
    // In a fully observed problem the state is what is observed.
    const std::byte* observation(std::int64_t i) const {
        return options_.partially_observed ? observations_[i] : states_[i];
    }

    // Starts a new episode where the mask is non-zero, or everywhere without one.
    void reset(const std::uint8_t* mask, std::byte* observations) {
        for_each_environment([&](Workspace&, std::int64_t i) {
            if (mask == nullptr || mask[i] != 0) start(i);
            write_observation(observations, i);
        });
    }

    void step(const std::byte* actions, const rddl_transition& out) {
        for_each_environment([&](Workspace& workspace, std::int64_t i) {
            copy_record(workspace.action[0], actions, i, engine_->action_size());
            step_environment(workspace, i, out);
        });
    }

    // The episode goes on from this state, unless it is terminal.
    void set_state(std::int64_t i, const std::byte* state) {
        std::memcpy(states_[i], state, engine_->state_size());
        end_if_terminal(*engine_, episode_of(i), states_[i]);
    }

    void violated_preconditions(const std::byte* actions, std::int32_t* first_violated) {
        for_each_environment([&](Workspace& workspace, std::int64_t i) {
            copy_record(workspace.action[0], actions, i, engine_->action_size());
            first_violated[i] = violated_precondition(workspace, i);
        });
    }

    // The action of the policy in each environment; the default one where the episode is over or
    // the policy faults. Only with an engine that has a policy.
    void act(const rddl_problem& problem, std::byte* actions) requires PolicyEngine<E> {
        const auto* const default_action = static_cast<const std::byte*>(problem.default_action);
        for_each_environment([&](Workspace& workspace, std::int64_t i) {
            Episode& episode = episode_of(i);
            if (!episode.over())
                decide(*engine_, problem, episode, observation(i), workspace.decision_buffers(),
                       memories_[i]);
            const std::byte* const action = episode.over() ? default_action : workspace.action[0];
            const std::size_t size = engine_->action_size();
            if (size > 0) std::memcpy(actions + static_cast<std::size_t>(i) * size, action, size);
        });
    }

    // One byte for each environment and choice (action_choices.hpp): is it allowed now?
    void action_mask(const rddl_problem& problem, std::uint8_t* masks) {
        const std::int64_t choices = choice_count(problem);
        for_each_environment([&](Workspace& workspace, std::int64_t i) {
            std::byte* const action = workspace.action[0];
            copy_record(action, static_cast<const std::byte*>(problem.default_action), 0,
                        engine_->action_size());
            for_each_choice(problem, action, [&](std::int64_t choice) {
                const bool allowed = choice == 0 || problem.max_nondef_actions != 0;
                masks[i * choices + choice] = allowed && violated_precondition(workspace, i) < 0;
            });
        });
    }

  private:
    // What one thread works in.
    struct Workspace {
        explicit Workspace(const E& engine)
            : action(1, engine.action_size()),
              scratch(1, engine.scratch_size()),
              next(1, engine.state_size()),
              observation(1, engine.observation_size()),
              next_memory(1, memory_size(engine)) {}

        StepBuffers step_buffers() { return {scratch[0], next[0], observation[0]}; }

        DecisionBuffers decision_buffers() { return {scratch[0], action[0], next_memory[0]}; }

        Records action;
        Records scratch;
        Records next;
        Records observation;
        Records next_memory;
    };

    std::size_t count() const { return static_cast<std::size_t>(options_.environment_count); }
    Episode& episode_of(std::int64_t i) { return episodes_[static_cast<std::size_t>(i)]; }
    std::byte* observation_of(std::int64_t i) {
        return options_.partially_observed ? observations_[i] : states_[i];
    }

    template <class Body>
    void for_each_environment(Body&& body) {
        team_.run([&](int worker) {
            const Range share = share_of(worker, team_.size(), environment_count());
            Workspace& workspace = workspaces_[static_cast<std::size_t>(worker)];
            for (std::int64_t i = share.begin; i < share.end; ++i) body(workspace, i);
        });
    }

    void start(std::int64_t i) {
        const auto identity =
            static_cast<std::uint64_t>(options_.first_environment) + static_cast<std::uint64_t>(i);
        start_next(*engine_, episode_of(i), options_.seed, identity, states_[i]);
        if (options_.partially_observed)
            std::memset(observations_[i], 0, engine_->observation_size());
        if constexpr (PolicyEngine<E>)
            if (engine_->has_policy()) engine_->reset_policy(memories_[i]);
    }

    // Of the action in the workspace.
    int violated_precondition(Workspace& workspace, std::int64_t i) const {
        Context<Scalar> context = episode(i).context_at(episode(i).steps + 1);
        return engine_->violated_precondition(states_[i], workspace.action[0], context);
    }

    void step_environment(Workspace& workspace, std::int64_t i, const rddl_transition& out) {
        Episode& episode = episode_of(i);
        double reward = 0.0;
        if (!episode.over())
            reward = advance(*engine_, episode, options_.horizon, workspace.action[0],
                             workspace.step_buffers(), states_[i], observation_of(i));
        else if (options_.autoreset == RDDL_AUTORESET_NEXT_STEP)
            start(i);

        if (out.rewards != nullptr) out.rewards[i] = reward;
        if (out.terminated != nullptr) out.terminated[i] = episode.terminated();
        if (out.truncated != nullptr) out.truncated[i] = episode.truncated();
        if (out.causes != nullptr) out.causes[i] = episode.causes;
        if (episode.over() && options_.autoreset == RDDL_AUTORESET_SAME_STEP) {
            write_observation(out.final_observations, i);
            start_keeping_fault(i);
        }
        write_observation(out.observations, i);
    }

    // The fault that ended an episode can be read until the next one makes a step.
    void start_keeping_fault(std::int64_t i) {
        Episode& episode = episode_of(i);
        const Episode ended = episode;
        start(i);
        if (episode.fault) return;
        episode.fault = ended.fault;
        episode.fault_steps = ended.fault_steps;
    }

    void write_observation(void* records, std::int64_t i) {
        const std::size_t size = engine_->observation_size();
        if (records != nullptr)
            std::memcpy(static_cast<std::byte*>(records) + static_cast<std::size_t>(i) * size,
                        observation(i), size);
    }

    static void copy_record(std::byte* target, const std::byte* records, std::int64_t i,
                            std::size_t size) {
        if (size > 0) std::memcpy(target, records + static_cast<std::size_t>(i) * size, size);
    }

    const E* engine_;
    BatchOptions options_;
    Records states_;
    Records observations_;  // empty when fully observed
    Records memories_;      // of the policy; empty without one
    std::vector<Episode> episodes_;
    std::vector<Workspace> workspaces_;
    Team team_;
};

}  // namespace rddl
