// Many environments of one simulator, stepped together.
//
// They lie in blocks of as many as the engine's lane type holds; environment i is lane i % width of
// block i / width. Each has its own state and episode; nothing is shared between them, so a
// trajectory does not depend on the batch around it or on the threads. Nothing is allocated after
// construction.
//
// Over 400 lines: one class, whose functions are those of simulator.h for batches.
#pragma once

#include <rddl/batch/action_choices.hpp>
#include <rddl/batch/environment.hpp>
#include <rddl/batch/record_checks.hpp>
#include <rddl/batch/threads.hpp>
#include <rddl/simulator.h>
#include <rddl/step/advance.hpp>
#include <rddl/step/columns.hpp>
#include <rddl/step/engine.hpp>
#include <rddl/step/episode.hpp>
#include <rddl/step/policy.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <optional>
#include <type_traits>
#include <vector>

namespace rddl {

// How a batch is made, checked and with all defaults resolved.
struct BatchOptions {
    std::int64_t environment_count = 1;
    std::int64_t first_environment = 0;
    std::uint64_t seed = 0;
    int thread_count = 1;
    rddl_autoreset autoreset = RDDL_AUTORESET_DISABLED;
    std::int64_t horizon = 0;  // 0: no horizon
    bool partially_observed = false;
    bool keeps_steps = false;
};

// The engine must outlive the batch.
template <StateEngine E>
class Batch {
  public:
    using L = typename E::Lane;
    using Bool = typename L::Bool;
    static constexpr int width = L::width;

    // Every environment starts its first episode. Throws std::bad_alloc.
    Batch(const E& engine, const rddl_problem& problem, const BatchOptions& options)
        : engine_(&engine),
          problem_(&problem),
          options_(options),
          state_columns_(columns_of<L>(problem, RDDL_STATE, problem.state_size)),
          action_columns_(columns_of<L>(problem, RDDL_ACTION, problem.action_size)),
          observation_columns_(options.partially_observed ? columns_of<L>(problem, RDDL_OBSERVATION,
                                                                          problem.observation_size)
                                                          : state_columns_),
          states_(2 * block_count(), engine.state_size()),
          observations_(options.partially_observed ? block_count() : 0, engine.observation_size()),
          actions_(keeps_actions() ? block_count() : 0, engine.action_size()),
          memories_(has_policy(engine) ? block_count() : 0, memory_size(engine)),
          streams_(make_streams()),
          last_steps_(options.keeps_steps ? count() : 0),
          last_states_(last_steps_.size(), static_cast<std::size_t>(problem.state_size)),
          last_actions_(last_steps_.size(), static_cast<std::size_t>(problem.action_size)),
          episodes_(block_count()),
          workspaces_(make_workspaces()),
          team_(options.thread_count),
          blocks_(blocks()),
          views_(make_views()) {
        for (int lane = lanes_of(episodes_.size() - 1); lane < width; ++lane)
            set_lane(episodes_.back().present, lane, false);
        reset(nullptr, nullptr);
        blocks_.start_running = all_run();
    }
    Batch(const Batch& other)
        : engine_(other.engine_),
          problem_(other.problem_),
          options_(other.options_),
          state_columns_(other.state_columns_),
          action_columns_(other.action_columns_),
          observation_columns_(other.observation_columns_),
          states_(other.states_),
          observations_(other.observations_),
          actions_(other.actions_),
          memories_(other.memories_),
          streams_(other.streams_),
          last_steps_(other.last_steps_),
          last_states_(other.last_states_),
          last_actions_(other.last_actions_),
          episodes_(other.episodes_),
          workspaces_(make_workspaces()),
          team_(other.options_.thread_count),
          blocks_(blocks()),
          views_(make_views()) {
        blocks_.start_running = other.blocks_.start_running;
    }
    Batch& operator=(const Batch&) = delete;

    std::int64_t environment_count() const { return options_.environment_count; }
    const BatchOptions& options() const { return options_; }
    const Columns& action_columns() const { return action_columns_; }

    // Whether the engine may be given these actions, one record for each environment, or `count`
    // states.
    bool accepts_actions(const std::byte* records) const {
        if (records == nullptr) return action_columns_.row_size == 0;
        return !action_columns_.has_objects ||
               records_are_valid(action_columns_, records, options_.environment_count);
    }
    // The same before a step. Some actions are read as they are checked.
    bool takes_actions(const std::byte* records) {
        if constexpr (has_byte_ints<L>) {
            if (records != nullptr && keeps_actions()) {
                const std::int64_t whole = options_.environment_count / width;
                const std::int64_t rest = options_.environment_count % width;
                return read_objects<L>(action_columns_, records, whole, actions_[0]) &&
                       records_are_valid(action_columns_,
                                         records + whole * width * action_columns_.row_size, rest);
            }
        }
        return accepts_actions(records);
    }
    bool accepts_states(const std::byte* records, std::int64_t count) const {
        return records_are_valid(state_columns_, records, count);
    }

    // Whether blocks can hold these states: byte ints are for those within the fluents' bounds.
    bool can_hold_states(const std::byte* records, std::int64_t count) const {
        if constexpr (has_byte_ints<L>) return states_are_bounded(*problem_, records, count);
        return true;
    }

    // --------------------------------------------------------------- one environment

    std::int64_t steps(std::int64_t i) const { return at(i).steps.of(lane_of(i)); }
    std::int64_t episode_number(std::int64_t i) const { return get_lane(at(i).number, lane_of(i)); }
    std::uint8_t causes(std::int64_t i) const { return at(i).ends.causes(lane_of(i)); }

    // The fault of the episode, or of the last one until this one makes a step; else null.
    const FaultRecord* fault(std::int64_t i) const {
        const bool faulty = get_lane(at(i).has_fault, lane_of(i));
        return faulty ? &at(i).faults[static_cast<std::size_t>(lane_of(i))] : nullptr;
    }
    std::int64_t steps_before_fault(std::int64_t i) const {
        return at(i).fault_steps[static_cast<std::size_t>(lane_of(i))];
    }

    void get_state(std::int64_t i, std::byte* record) const {
        write_record(L{}, state_columns_, state(i / width), lane_of(i), record);
    }
    // The states of environments [begin, begin + count).
    void get_states(std::int64_t begin, std::int64_t count, std::byte* records) const {
        const std::int64_t size = state_columns_.row_size;
        for_each_part(
            begin, count,
            [&](std::int64_t b) {
                write_records(L{}, state_columns_, state(b), records + (b * width - begin) * size,
                              width);
            },
            [&](std::int64_t i) { get_state(i, records + (i - begin) * size); });
    }
    // A fully observed problem observes its state.
    void get_observation(std::int64_t i, std::byte* record) const {
        write_record(L{}, observation_columns_, observed(i / width), lane_of(i), record);
    }
    // The episode continues from this state after so many steps (null: as many as before), unless
    // the state is terminal or these reach the horizon.
    void set_state(std::int64_t i, const std::byte* record, const std::int64_t* steps) {
        read_record(L{}, state_columns_, record, state(i / width), lane_of(i));
        if (steps != nullptr) at(i).steps.set(lane_of(i), *steps);
        set_lane(at(i).has_fault, lane_of(i), false);
        end_if_terminal(*engine_, at(i), only(i), state(i / width));
        if (steps != nullptr && *steps >= blocks_.horizon && !(causes(i) & RDDL_FAULTED))
            set_lane(at(i).ends.beyond_horizon, lane_of(i), true);
    }

    // The same for environments [begin, begin + count).
    void set_states(std::int64_t begin, std::int64_t count, const std::byte* records,
                    const std::int64_t* steps) {
        const std::int64_t size = state_columns_.row_size;
        const auto steps_from = [&](std::int64_t i) {
            return steps != nullptr ? steps + (i - begin) : nullptr;
        };
        for_each_part(
            begin, count,
            [&](std::int64_t b) {
                set_block(b, records + (b * width - begin) * size, steps_from(b * width));
            },
            [&](std::int64_t i) { set_state(i, records + (i - begin) * size, steps_from(i)); });
    }

    // Sets the random numbers from now on, and of the episodes that follow, which are counted from
    // 0.
    void set_stream(std::int64_t i, const Stream& stream) {
        set_lane(at(i).number, lane_of(i), std::int64_t{-1});
        if (streams_.empty()) return;
        streams_[index(i)] = stream;
        if (i > 0 && streams_[index(i - 1)] == stream && episode_number(i - 1) == -1) {
            set_lane(at(i).key_low, lane_of(i), get_lane(at(i - 1).key_low, lane_of(i - 1)));
            set_lane(at(i).key_high, lane_of(i), get_lane(at(i - 1).key_high, lane_of(i - 1)));
        } else {
            set_keys(blocks_, i / width, only(i));
        }
    }
    // The same for environments [begin, begin + count), by stream_of(i).
    template <class StreamOf>
    void set_streams(std::int64_t begin, std::int64_t count, StreamOf&& new_stream_of) {
        for_each_part(
            begin, count,
            [&](std::int64_t b) {
                at(b * width).number = typename L::Count{-1};
                if (streams_.empty()) return;
                for (std::int64_t i = b * width; i < (b + 1) * width; ++i)
                    streams_[index(i)] = new_stream_of(i);
                set_keys(blocks_, b, Bool{true});
            },
            [&](std::int64_t i) { set_stream(i, new_stream_of(i)); });
    }
    // Sets the seed as in a new batch.
    void set_seed(std::uint64_t seed) {
        options_.seed = seed;
        for (std::int64_t i = 0; i < options_.environment_count; ++i) set_stream(i, stream_of(i));
    }

    void get_environment(std::int64_t i, Environment& to) const {
        get_state(i, to.state[0]);
        if (options_.partially_observed) get_observation(i, to.observation[0]);
        if constexpr (PolicyEngine<E>)
            copy_record(to.memory[0], memories_[i / width], memory_size(*engine_));
        to.episode = at(i).of(lane_of(i));
        if (!streams_.empty()) to.stream = streams_[index(i)];
        to.last_step.reset();
        if (!keeps_steps()) return;
        to.last_step = last_steps_[index(i)];
        copy_record(to.last_state[0], last_states_[i], state_size());
        copy_record(to.last_action[0], last_actions_[i], action_size());
    }
    void set_environment(std::int64_t i, const Environment& from) {
        const int lane = lane_of(i);
        read_record(L{}, state_columns_, from.state[0], state(i / width), lane);
        if (options_.partially_observed)
            read_record(L{}, observation_columns_, from.observation[0], observations_[i / width],
                        lane);
        if constexpr (PolicyEngine<E>)
            copy_record(memories_[i / width], from.memory[0], memory_size(*engine_));
        at(i).set(lane, from.episode);
        if (!streams_.empty()) streams_[index(i)] = from.stream;
        if (!keeps_steps()) return;
        last_steps_[index(i)] = from.last_step;
        copy_record(last_states_[i], from.last_state[0], state_size());
        copy_record(last_actions_[i], from.last_action[0], action_size());
    }

    // The same for environments [begin, begin + count). Blocks that are all copies are copied
    // whole.
    void set_environments(std::int64_t begin, std::int64_t count, const Environment& from) {
        const std::int64_t end = begin + count;
        for (std::int64_t i = begin; i < end;) {
            const bool is_whole = width > 1 && i % width == 0 && i + width <= end && !keeps_steps();
            if (is_whole && i - begin >= width)
                repeat_block(i / width);
            else if (is_whole)
                fill_block(i / width, from);
            else
                set_environment(i, from);
            i += is_whole ? width : 1;
        }
    }

    // -------------------------------------------------------------- all environments

    // Starts a new episode where the mask is non-zero, or everywhere without one.
    void reset(const std::uint8_t* mask, std::byte* observations) {
        for_each_block([&](Workspace& workspace, std::int64_t b) {
            Bool chosen = episodes_[index(b)].present;
            for (int lane = 0; mask != nullptr && lane < lanes_of(b); ++lane)
                set_lane(chosen, lane, mask[b * width + lane] != 0);
            start(workspace, b, chosen);
            write_observations(observations, b);
        });
    }

    void step(const std::byte* actions, const rddl_transition& out) {
        if (keeps_steps())
            for_each_block([&](Workspace& workspace, std::int64_t b) {
                keep_step(b, block_of_actions(workspace, actions, b));
            });
        for_each_share([&](Workspace& workspace, Range share) {
            while (share.begin < share.end) share.begin = step_some(workspace, share, actions, out);
        });
    }
    // The view of the only environment, whose steps are not kept; else null.
    const BatchView<L>* only_one() const {
        const bool is_one = width == 1 && options_.environment_count == 1;
        return is_one && !keeps_steps() ? views_.data() : nullptr;
    }

    // The same with matrices of numbers; `observations` may be null.
    template <class Number>
    void step_values(const Number* actions, Number* observations, const rddl_transition& out) {
        for_each_block([&](Workspace& workspace, std::int64_t b) {
            read_values(L{}, action_columns_, actions + b * width * action_columns_.value_count,
                        lanes_of(b), workspace.action[0]);
            if (keeps_steps()) keep_step(b, workspace.action[0]);
            workspace.number = std::is_same_v<Number, float> ? RDDL_FLOAT : RDDL_DOUBLE;
            step_blocks(workspace, {b, b + 1}, {nullptr, workspace.action[0]}, out);
            workspace.number.reset();
            if (observations != nullptr) write_observation_values(observations, b);
        });
    }
    template <class Number>
    void get_observation_values(Number* observations) const {
        for (std::size_t b = 0; b < block_count(); ++b)
            write_observation_values(observations, static_cast<std::int64_t>(b));
    }

    // The first violated precondition of each environment's action, or -1.
    void violated_preconditions(const std::byte* actions, std::int32_t* first_violated) {
        for_each_block([&](Workspace& workspace, std::int64_t b) {
            const auto first =
                violated_precondition_of_block(b, block_of_actions(workspace, actions, b));
            for (int lane = 0; lane < lanes_of(b); ++lane)
                first_violated[b * width + lane] = static_cast<std::int32_t>(get_lane(first, lane));
        });
    }

    // The violated precondition of one environment and action.
    std::int64_t violated_precondition(std::int64_t i, const std::byte* action) {
        Workspace& workspace = workspaces_.front();
        read_record(L{}, action_columns_, action, workspace.action[0], lane_of(i));
        return get_lane(violated_precondition_of_block(i / width, workspace.action[0]), lane_of(i));
    }
    // The context in which the environment's next step is evaluated.
    Context<Scalar> context_of_next_step(std::int64_t i) const {
        return at(i).of(lane_of(i)).context_of_step(true);
    }

    bool keeps_steps() const { return options_.keeps_steps; }
    // The last step, for batches that keep steps; nothing before the first one.
    std::optional<LastStep> last_step(std::int64_t i) const {
        const auto& context = last_steps_[index(i)];
        if (!context) return std::nullopt;
        return LastStep{last_states_[i], last_actions_[i], *context};
    }

    // The action of the policy in each environment; the default one where the episode is over or
    // the policy faults. Only with an engine that has a policy.
    void act(std::byte* actions) requires PolicyEngine<E> &&(width == 1) {
        const auto* const default_action = static_cast<const std::byte*>(problem_->default_action);
        for_each_block([&](Workspace& workspace, std::int64_t b) {
            decide(*engine_, *problem_, episodes_[index(b)], observed(b),
                   workspace.decision_buffers(), memories_[b]);
            const bool over = !episodes_[index(b)].running();
            const std::size_t size = engine_->action_size();
            if (size > 0)
                std::memcpy(actions + index(b) * size, over ? default_action : workspace.action[0],
                            size);
        });
    }

    // One byte for each environment and choice (action_choices.hpp): is it allowed now, in place of
    // the default action (null), or as a change of the environment's own one?
    void action_mask(const std::byte* actions, std::uint8_t* masks) {
        const std::int64_t choices = choice_count(*problem_);
        for_each_block([&](Workspace& workspace, std::int64_t b) {
            std::uint8_t* const rows = masks + b * width * choices;
            const int lanes = lanes_of(b);
            std::array<std::int64_t, width> changed{};
            for (int lane = 0; lane < lanes; ++lane) {
                std::byte* const action = copy_of_action(workspace, actions, b, lane);
                changed[index(lane)] = count_non_default(*problem_, action);
            }
            const Bool stands = satisfies_preconditions(workspace, b);
            for (int lane = 0; lane < lanes; ++lane)
                rows[lane * choices] =
                    get_lane(stands, lane) && is_within_limit(changed[index(lane)]);
            for_each_choice(*problem_, [&](std::int64_t choice, const Change& change) {
                std::array<std::int64_t, width> before{};
                for (int lane = 0; lane < lanes; ++lane)
                    before[index(lane)] = change.exchange(workspace.choices[lane], change.value);
                const Bool legal = satisfies_preconditions(workspace, b);
                for (int lane = 0; lane < lanes; ++lane) {
                    const std::int64_t old = before[index(lane)];
                    const std::int64_t others =
                        changed[index(lane)] - (old != change.default_value);
                    rows[lane * choices + choice] =
                        get_lane(legal, lane) && old != change.value && is_within_limit(others + 1);
                    change.exchange(workspace.choices[lane], old);
                }
            });
        });
    }

  private:
    // The buffers of one thread.
    struct Workspace {
        Workspace(const E& engine, const rddl_problem& problem)
            : action(1, engine.action_size()),
              choices(width, static_cast<std::size_t>(problem.action_size)),
              scratch(1, engine.scratch_size()),
              next(1, engine.state_size()),
              observation(1, engine.observation_size()),
              next_memory(1, memory_size(engine)),
              step_buffers{action[0], scratch[0], next[0], observation[0]} {}

        DecisionBuffers decision_buffers() { return {scratch[0], action[0], next_memory[0]}; }

        Records action;
        Records choices;  // a record of the C interface for each lane
        Records scratch;
        Records next;
        Records observation;
        Records next_memory;
        std::optional<rddl_number> number;  // of the matrices of the step under way
        StepBuffers step_buffers;  // in the records above, which stay where they are when moved
    };

    std::vector<Workspace> make_workspaces() const {
        std::vector<Workspace> workspaces;
        for (int k = 0; k < options_.thread_count; ++k)
            workspaces.emplace_back(*engine_, *problem_);
        return workspaces;
    }

    // Empty if nothing is drawn.
    std::vector<Stream> make_streams() const {
        if (problem_->stochastic == 0 && !has_policy(*engine_)) return {};
        std::vector<Stream> streams;
        for (std::int64_t i = 0; i < options_.environment_count; ++i)
            streams.push_back(stream_of(i));
        return streams;
    }
    Stream stream_of(std::int64_t i) const {
        return {options_.seed, static_cast<std::uint64_t>(options_.first_environment) +
                                   static_cast<std::uint64_t>(i)};
    }

    Blocks<L> blocks() {
        constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();
        return {
            .environment_count = options_.environment_count,
            .horizon = options_.horizon > 0 ? options_.horizon : never,
            .autoreset = options_.autoreset,
            .start_running = false,
            .streams = streams_.empty() ? nullptr : streams_.data(),
            .episodes = episodes_.data(),
            .states = states_[0],
            .observations = options_.partially_observed ? observations_[0] : nullptr,
            .actions = actions_[0],
            .state_columns = &state_columns_,
            .action_columns = &action_columns_,
            .observation_columns = &observation_columns_,
            .action_alignment_bits = static_cast<std::uintptr_t>(action_columns_.alignment - 1)};
    }

    bool all_run() const {
        return std::ranges::none_of(episodes_, [](const auto& some) { return any(some.over()); });
    }

    static constexpr int lane_of(std::int64_t i) { return static_cast<int>(i % width); }
    static constexpr std::size_t index(std::int64_t b) { return static_cast<std::size_t>(b); }

    bool keeps_actions() const { return are_read_when_checked<L>(action_columns_); }

    // Sizes of records of the C interface.
    std::size_t state_size() const { return static_cast<std::size_t>(problem_->state_size); }
    std::size_t action_size() const { return static_cast<std::size_t>(problem_->action_size); }
    std::size_t count() const { return static_cast<std::size_t>(options_.environment_count); }
    std::size_t block_count() const {
        return static_cast<std::size_t>((options_.environment_count - 1) / width + 1);
    }
    // Environments in the block.
    int lanes_of(std::size_t b) const { return lanes_of(static_cast<std::int64_t>(b)); }
    int lanes_of(std::int64_t b) const { return blocks_.lanes_of(b); }
    // As its columns have it.
    std::byte* state(std::int64_t b) const {
        std::byte* const record = states_[2 * b + episodes_[index(b)].state];
        if constexpr (width > 1) settle(*engine_, record);
        return record;
    }
    // Nothing but the lane of this environment.
    static Bool only(std::int64_t i) {
        Bool lanes{false};
        set_lane(lanes, lane_of(i), true);
        return lanes;
    }
    Episodes<L>& at(std::int64_t i) { return episodes_[index(i / width)]; }
    const Episodes<L>& at(std::int64_t i) const { return episodes_[index(i / width)]; }
    std::byte* observed(std::int64_t b) {
        return options_.partially_observed ? observations_[b] : state(b);
    }
    const std::byte* observed(std::int64_t b) const {
        return options_.partially_observed ? observations_[b] : state(b);
    }

    // Calls whole(b) for the blocks of environments [begin, begin + count), and one(i) for what is
    // left of them at both ends.
    template <class Whole, class One>
    static void for_each_part(std::int64_t begin, std::int64_t count, Whole&& whole, One&& one) {
        const std::int64_t end = begin + count;
        for (std::int64_t i = begin; i < end;) {
            const bool is_whole = width > 1 && i % width == 0 && i + width <= end;
            if (is_whole)
                whole(i / width);
            else
                one(i);
            i += is_whole ? width : 1;
        }
    }

    // The states of all environments of a block.
    void set_block(std::int64_t b, const std::byte* records, const std::int64_t* steps) {
        Episodes<L>& episodes = episodes_[index(b)];
        read_records(L{}, state_columns_, records, width, state(b));
        episodes.has_fault = Bool{false};
        for (int lane = 0; steps != nullptr && lane < width; ++lane)
            episodes.steps.set(lane, steps[lane]);
        end_if_terminal(*engine_, episodes, Bool{true}, state(b));
        if (steps == nullptr) return;
        const Bool are_late{episodes.steps.all() >= typename L::Count{blocks_.horizon}};
        episodes.ends.beyond_horizon =
            episodes.ends.beyond_horizon || (are_late && !episodes.ends.faulted);
    }

    template <class Body>
    void for_each_share(Body&& body) {
        team_.run([&](int worker) {
            const auto blocks = static_cast<std::int64_t>(block_count());
            body(workspaces_[static_cast<std::size_t>(worker)],
                 share_of(worker, team_.size(), blocks, 64 / width));
        });
    }
    template <class Body>
    void for_each_block(Body&& body) {
        for_each_share([&](Workspace& workspace, Range share) {
            for (std::int64_t b = share.begin; b < share.end; ++b) body(workspace, b);
        });
    }

    // The actions of a block, by all environments' rows.
    const std::byte* block_of_actions(Workspace& workspace, const std::byte* rows,
                                      std::int64_t b) const {
        return as_block(workspace, rows + b * width * action_columns_.row_size, b);
    }
    // The block's action records, from its own rows.
    const std::byte* as_block(Workspace& workspace, const std::byte* rows, std::int64_t b) const {
        read_records(L{}, action_columns_, rows, lanes_of(b), workspace.action[0]);
        return workspace.action[0];
    }
    BatchView<L> view_of(const Workspace& workspace, const Blocks<L>& blocks) {
        const auto do_rest = [](const BatchView<L>& view, std::int64_t b, Rest rest,
                                Actions actions, const rddl_transition& out) {
            Batch& self = *static_cast<Batch*>(view.batch);
            const std::int64_t made = rest == Rest::Observations;
            const Stop<L> stop{b + made, rest == Rest::NextEpisode};
            self.go_on(self.workspaces_[index(view.thread)], {b, b + 1}, stop, actions, out);
            return RDDL_OK;
        };
        const auto thread = static_cast<int>(&workspace - workspaces_.data());
        return {blocks, workspace.step_buffers, thread, this, do_rest};
    }

    std::vector<BatchView<L>> make_views() {
        std::vector<BatchView<L>> views;
        for (const Workspace& workspace : workspaces_) views.push_back(view_of(workspace, blocks_));
        return views;
    }

    void start(Workspace& workspace, std::int64_t b, Bool lanes) {
        Episodes<L>& episodes = episodes_[index(b)];
        episodes.has_fault = episodes.has_fault && !lanes;
        start_keeping_faults(workspace, b, lanes);
    }
    void start_keeping_faults(Workspace& workspace, std::int64_t b, Bool lanes) {
        start_next(*engine_, blocks_, b, lanes, workspace.next[0]);
        if (options_.partially_observed) clear_observations(workspace, b, lanes);
        if constexpr (PolicyEngine<E>)
            if (engine_->has_policy() && any(lanes)) engine_->reset_policy(memories_[b]);
    }
    void clear_observations(Workspace& workspace, std::int64_t b, Bool lanes) {
        std::memset(workspace.observation[0], 0, engine_->observation_size());
        merge(L{}, observation_columns_, lanes, workspace.observation[0], observations_[b]);
    }

    typename L::Int violated_precondition_of_block(std::int64_t b, const std::byte* actions) const {
        const Episodes<L>& episodes = episodes_[index(b)];
        Context<L> context = episodes.context_of_step(episodes.present);
        return engine_->violated_precondition(state(b), actions, context);
    }

    // Keeps the next step of the running environments.
    void keep_step(std::int64_t b, const std::byte* actions) {
        for (int lane = 0; lane < lanes_of(b); ++lane) {
            const std::int64_t i = b * width + lane;
            if (causes(i) != RDDL_RUNNING) continue;
            get_state(i, last_states_[i]);
            write_record(L{}, action_columns_, actions, lane, last_actions_[i]);
            last_steps_[index(i)] = context_of_next_step(i);
        }
    }

    // A lane's action, or the default one, to be changed.
    std::byte* copy_of_action(Workspace& workspace, const std::byte* actions, std::int64_t b,
                              int lane) const {
        const std::int64_t size = problem_->action_size;
        const auto* const action = actions != nullptr
                                       ? actions + (b * width + lane) * size
                                       : static_cast<const std::byte*>(problem_->default_action);
        copy_record(workspace.choices[lane], action, static_cast<std::size_t>(size));
        return workspace.choices[lane];
    }
    // Whether the actions in workspace.choices satisfy the preconditions.
    Bool satisfies_preconditions(Workspace& workspace, std::int64_t b) const {
        const auto first =
            violated_precondition_of_block(b, as_block(workspace, workspace.choices[0], b));
        return Bool(first < typename L::Int{0});
    }
    bool is_within_limit(std::int64_t changed) const {
        return problem_->max_nondef_actions < 0 || changed <= problem_->max_nondef_actions;
    }

    // Steps as many blocks from range.begin on as can be stepped together; the first one left.
    std::int64_t step_some(Workspace& workspace, Range range, const std::byte* rows,
                           const rddl_transition& out) {
        const std::int64_t b = range.begin;
        const bool whole = width == 1 ? blocks_.are_blocks(rows) : lanes_of(b) == width;
        if (!whole) {
            const std::byte* const block = block_of_actions(workspace, rows, b);
            return step_blocks(workspace, {b, b + 1}, {nullptr, block}, out);
        }
        // A block whose observations are written is in the cache only if no other one follows.
        const bool alone = !advances_many(*engine_) || out.observations != nullptr;
        range.end = alone ? b + 1 : std::min(range.end, options_.environment_count / width);
        return step_blocks(workspace, range, {rows, nullptr}, out);
    }
    std::int64_t step_blocks(Workspace& workspace, Range range, Actions actions,
                             const rddl_transition& out) {
        if constexpr (width == 1) {
            if (range.end == range.begin + 1) {
                const BatchView<L>& view = views_[index(&workspace - workspaces_.data())];
                advance_one(*engine_, view, range.begin, actions, out);
                return range.end;
            }
        }
        const Stop<L> stop =
            advance(*engine_, blocks_, range, actions, workspace.step_buffers, out);
        if (stop.block == range.end && out.observations == nullptr) return range.end;
        return go_on(workspace, range, stop, actions, out);
    }

    // Finishes a step of blocks that stopped; returns the first block that has made no step.
    std::int64_t go_on(Workspace& workspace, Range range, Stop<L> stop, Actions actions,
                       const rddl_transition& out) {
        if (any(stop.over))
            start_after_step(workspace, stop.block, stop.over, out);
        else if (stop.block < range.end)
            start_instead(workspace, stop.block, actions, out);
        const std::int64_t end = std::min(stop.block + 1, range.end);
        for (std::int64_t b = range.begin; out.observations != nullptr && b < end; ++b)
            write_observations(out.observations, b);
        return end;
    }

    // All environments of a block become the same.
    void fill_block(std::int64_t b, const Environment& from) {
        set_environment(b * width, from);
        repeat_lane(L{}, state_columns_, state(b));
        if (options_.partially_observed) repeat_lane(L{}, observation_columns_, observations_[b]);
        for (int lane = 1; lane < width; ++lane) episodes_[index(b)].set(lane, from.episode);
        if (!streams_.empty()) std::fill_n(streams_.begin() + b * width, width, from.stream);
    }
    // A whole block becomes as the one before it.
    void repeat_block(std::int64_t b) {
        copy_record(state(b), state(b - 1), engine_->state_size());
        if (options_.partially_observed)
            copy_record(observations_[b], observations_[b - 1], engine_->observation_size());
        const std::int64_t which = episodes_[index(b)].state;
        episodes_[index(b)] = episodes_[index(b - 1)];
        episodes_[index(b)].state = which;
        if (streams_.empty()) return;
        const auto first = streams_.begin() + b * width;
        std::copy_n(first - width, width, first);
    }

    // A step of a block where some episodes are over: the next ones start instead.
    void start_instead(Workspace& workspace, std::int64_t b, Actions actions,
                       const rddl_transition& out) {
        const Bool were_over = episodes_[index(b)].over();
        Blocks<L> without_resets = blocks_;
        without_resets.autoreset = RDDL_AUTORESET_DISABLED;
        rddl_transition without_observations = out;
        without_observations.observations = nullptr;
        if constexpr (width == 1)
            advance_one(*engine_, view_of(workspace, without_resets), b, actions,
                        without_observations);
        else
            advance(*engine_, without_resets, {b, b + 1}, actions, workspace.step_buffers,
                    without_observations);
        start(workspace, b, were_over);
        write_ends(b * width, lanes_of(b), episodes_[index(b)].ends, out);
    }

    // The next episodes of lanes whose episodes the step ended.
    void start_after_step(Workspace& workspace, std::int64_t b, Bool lanes,
                          const rddl_transition& out) {
        if (wants_finals(out)) write_finals(workspace, b, lanes, out);
        start_keeping_faults(workspace, b, lanes);
    }

    void write_observations(void* records, std::int64_t b) const {
        if (records == nullptr) return;
        const std::int64_t size = observation_columns_.row_size;
        write_records(L{}, observation_columns_, observed(b),
                      static_cast<std::byte*>(records) + b * width * size, lanes_of(b));
    }
    template <class Number>
    void write_observation_values(Number* observations, std::int64_t b) const {
        write_values(L{}, observation_columns_, observed(b),
                     observations + b * width * observation_columns_.value_count, 0, lanes_of(b));
    }
    void write_finals(const Workspace& workspace, std::int64_t b, Bool lanes,
                      const rddl_transition& out) const {
        const auto row = [](void* rows, const Columns& columns, std::int64_t i) {
            return static_cast<std::byte*>(rows) + i * columns.row_size;
        };
        for_each_lane(lanes, [&](int lane) {
            const std::int64_t i = b * width + lane;
            if (out.final_observations != nullptr)
                get_observation(i, row(out.final_observations, observation_columns_, i));
            if (out.final_states != nullptr) get_state(i, row(out.final_states, state_columns_, i));
            if (out.final_observation_values == nullptr || !workspace.number) return;
            if (*workspace.number == RDDL_FLOAT)
                write_final_values(static_cast<float*>(out.final_observation_values), i);
            else
                write_final_values(static_cast<double*>(out.final_observation_values), i);
        });
    }
    template <class Number>
    void write_final_values(Number* matrix, std::int64_t i) const {
        write_values(L{}, observation_columns_, observed(i / width),
                     matrix + i * observation_columns_.value_count, lane_of(i), lane_of(i) + 1);
    }

    static void copy_record(std::byte* target, const std::byte* record, std::size_t size) {
        if (size > 0) std::memcpy(target, record, size);
    }

    const E* engine_;
    const rddl_problem* problem_;
    BatchOptions options_;
    Columns state_columns_, action_columns_, observation_columns_;
    mutable Records states_;       // two for each block, which may be settled
    Records observations_;         // blocks; empty when fully observed
    Records actions_;              // blocks; empty unless they are read when they are checked
    Records memories_;             // of the policy; empty without a policy
    std::vector<Stream> streams_;  // of each environment; empty if nothing is drawn
    // The last step of each environment, if they are kept.
    std::vector<std::optional<Context<Scalar>>> last_steps_;
    Records last_states_, last_actions_;
    std::vector<Episodes<L>> episodes_;
    std::vector<Workspace> workspaces_;
    Team team_;
    Blocks<L> blocks_;                 // of the members above
    std::vector<BatchView<L>> views_;  // of each thread, so that the batch cannot be moved
};

}  // namespace rddl
