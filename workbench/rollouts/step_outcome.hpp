// The observable outcome of one step of one environment, and the differences between two engines.
#pragma once

#include "formats/records_json.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rddlc::workbench {

using Record = std::vector<std::byte>;

struct StepOutcome {
    std::uint8_t causes_before = RDDL_RUNNING;  // if not, no step was made: only the state counts
    std::optional<Record> action;               // of the policy block, if it was asked
    std::int32_t violated_precondition = -1;    // the first, or -1
    Record state;                               // after the step
    Record observation;                         // of partially observed problems
    double reward = 0;
    std::uint8_t causes = RDDL_RUNNING;
    std::string fault;  // place and message; state, observation and reward are not results then
};

// How far two engines may be apart.
struct Tolerance {
    // The tolerance of reals, relative to the greater one; 0: bit for bit (but one nan is like
    // another).
    double of_reals = 0;
    // If the expected real is inf or nan, any value is accepted (docs/fast-math.md).
    bool only_finite = false;

    bool accepts(double expected, double found) const;
};

enum class Shown : std::uint8_t {
    Start,  // whether the episode is over before the step
    Action,
    Precondition,
    Fault,
    State,
    Observation,
    Reward,
    Ending
};

struct Difference {
    Shown what;
    std::string name;                       // "water'(t1)", "the reward", ...
    std::optional<std::int32_t> fluent;     // of a value: index into rddl_problem::fluents
    std::optional<std::int32_t> condition;  // of a precondition: the first of both
    std::string expected, found;            // as JSON, or in words
};

// How many values were compared, of what kind.
struct ValueCounts {
    std::int64_t states = 0, observations = 0, rewards = 0, actions = 0;
    std::int64_t conditions = 0;  // preconditions, invariants and terminations, each as one answer
    std::int64_t faults = 0;      // whether and where a step faults
    std::int64_t rounded = 0;     // reals that are not the same bits, but within the tolerance
    double largest_rounding = 0;  // relative

    std::int64_t total() const {
        return states + observations + rewards + actions + conditions + faults;
    }
};

class OutcomeComparison {
  public:
    // `problem` must outlive this.
    explicit OutcomeComparison(const rddl_problem& problem);

    // The first difference; if all is within the tolerance, nothing is returned, but counted in
    // `counts`. `otherwise` are outcomes that are also correct, with other last digits: an expected
    // value within their range, or no farther from `found` than they are, is not a difference.
    std::optional<Difference> compare(const StepOutcome& expected, const StepOutcome& found,
                                      Tolerance tolerance, ValueCounts& counts,
                                      std::span<const StepOutcome> otherwise = {}) const;
    // The values that the outcome has.
    void count(const StepOutcome& outcome, ValueCounts& counts) const;

    const RecordLayout& state() const { return state_; }
    const RecordLayout& action() const { return action_; }
    const RecordLayout& observation() const { return observation_; }

  private:
    std::optional<Difference> compare_records(Shown what, const RecordLayout& layout,
                                              const Record& expected, const Record& found,
                                              Tolerance tolerance, ValueCounts& counts,
                                              const std::vector<const Record*>& otherwise) const;
    std::string name_of(Shown what, const RecordEntry& entry) const;
    Difference precondition(std::int32_t expected, std::int32_t found) const;

    const rddl_problem& problem_;
    RecordLayout state_, action_, observation_;
};

// |a - b| / max(|a|, |b|); 0 where they are equal or both nan, infinite where one is not finite.
double relative_difference(double a, double b);

}  // namespace rddlc::workbench
