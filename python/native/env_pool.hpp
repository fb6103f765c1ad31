// Environments of one simulator, and the arrays that they read and fill.
#pragma once

#include "native/long_calls.hpp"
#include "native/problem.hpp"
#include "solvers/batches/batch.hpp"
#include "solvers/spaces/actions.hpp"

#include <rddl/simulator.h>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::python {

struct EnvPoolSettings {
    std::int64_t environments = 1;
    int threads = 0;  // 0: one per core
    rddl_autoreset autoreset = RDDL_AUTORESET_DISABLED;
    std::int64_t horizon = 0;  // 0: the instance's; RDDL_NO_HORIZON: no horizon
    bool doubles = false;      // the matrices of numbers
    bool shows_records = true, shows_values = true;  // what steps and resets fill
};

// The arrays that a step writes in place of the batch's own; null: the batch's.
struct Outputs {
    void* values = nullptr;  // a matrix
    double* rewards = nullptr;
    std::uint8_t* terminated = nullptr;
    std::uint8_t* truncated = nullptr;
    nanobind::handle kept;  // whose memory that is
};

// Its arrays stay where they are, so that Python reads them without copies. Values are the same
// numbers as records, a column each. Functions that step release Python's lock. A step that Ctrl-C
// interrupts still completes; the next call waits for it.
class EnvPool {
  public:
    EnvPool(workbench::Simulator simulator, const EnvPoolSettings& settings);
    EnvPool(const EnvPool& other);
    EnvPool& operator=(const EnvPool&) = delete;

    const rddl_simulator& simulator() const { return *simulator_; }
    const workbench::Simulator& shared_simulator() const { return simulator_; }
    const EnvPoolSettings& settings() const { return settings_; }
    rddl_batch* handle() { return live(); }

    void reset(const std::uint8_t* mask);
    // Steps by the rows of action_records, or of these values: floats or doubles. Returns whether
    // an episode has ended.
    bool step(const Outputs& outputs);
    bool step_values(const Outputs& outputs, const void* values, nanobind::handle kept = {});
    bool step_values(const Outputs& outputs) {
        return step_values(outputs, arrays_.action_values.data());
    }
    // The memory of a tuple of arrays: values or None, rewards, terminated, truncated. None: the
    // batch's own.
    Outputs outputs_in(nanobind::handle arrays) const;
    // Waits for a step that Ctrl-C has left.
    void finish() { calls_.finish(); }
    void set_seed(std::uint64_t seed);
    void set_seeds(std::int64_t begin, std::span<const std::uint64_t> seeds);

    void read_state(std::int64_t environment, std::byte* record);
    // All environments: states, steps of their episodes, episodes before these, and causes.
    void read_states(std::byte* records, std::int64_t* steps, std::int64_t* episodes,
                     std::uint8_t* causes);
    // States, one behind the other, of the environments at these places, after so many steps.
    void write_states(std::span<const std::int64_t> places, const std::byte* records,
                      std::span<const std::int64_t> steps);
    // Its environments, and what they will draw, are those of the other, which has as many of the
    // same simulator.
    void become(EnvPool& other);
    void read_interm(std::int64_t environment, std::byte* record);
    std::pair<std::int64_t, std::int64_t> progress(std::int64_t environment);  // steps, episodes
    std::uint8_t causes(std::int64_t environment);
    std::string fault(std::int64_t environment);

    // The first precondition that the action of each environment violates, or -1: for records, or
    // for rows of values, which are floats.
    std::vector<std::int32_t> violated_preconditions(std::span<const std::byte> actions);
    std::vector<std::int32_t> violated_preconditions(std::span<const float> values);
    std::string explain_violation(std::int64_t environment);
    void action_masks(std::uint8_t* masks);
    // The action that the policy block chooses, into action_records.
    void act();

    struct Arrays {
        std::vector<std::byte> actions, observations, final_observations, final_states;
        std::vector<std::byte> action_values, observation_values, final_values;
        std::vector<double> rewards;
        std::vector<std::uint8_t> terminated, truncated, causes;
    };
    Arrays& arrays() { return arrays_; }
    std::int64_t action_columns() const { return action_columns_; }
    std::int64_t observation_columns() const { return observation_columns_; }

  private:
    rddl_number number() const { return settings_.doubles ? RDDL_DOUBLE : RDDL_FLOAT; }
    rddl_transition transition(const Outputs& outputs);
    std::size_t number_size() const { return settings_.doubles ? sizeof(double) : sizeof(float); }
    rddl_batch* live();
    void read_values(void* values);
    void read_observations();  // records, and values
    bool has_ended() const;

    workbench::Simulator simulator_;  // outlives the batch
    EnvPoolSettings settings_;
    solvers::BatchHandle batch_;
    std::int64_t process_;  // whose threads the batch has
    std::int64_t action_columns_, observation_columns_;
    Arrays arrays_;
    solvers::ActionRecords records_of_values_;
    LongCalls calls_;  // the last one: a step that still runs writes into the others
};

void add_env_pool(nanobind::module_& module);

}  // namespace rddlc::python
