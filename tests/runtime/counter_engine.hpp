// An engine without emitted code behind it: a counter that the action moves and that is observed
// with noise. The tests choose when its episodes end.
#pragma once

#include <rddl/batch/batch.hpp>
#include <rddl/random/distributions.hpp>
#include <rddl/step/engine.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace rddl {

struct CounterEngine {
    using Lane = Scalar;
    static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

    std::int64_t initial = 0;
    std::int64_t terminal_from = never;    // a count that ends the episode
    std::int64_t forbidden_from = never;   // a count that violates the invariant
    std::int64_t faulty_from = never;      // a count that no step may leave
    std::int64_t faulty_terminal = never;  // a count whose termination cannot be evaluated
    bool faulty_reset = false;

    std::size_t state_size() const { return sizeof(std::int64_t); }
    std::size_t action_size() const { return sizeof(std::int64_t); }
    std::size_t observation_size() const { return sizeof(double); }
    std::size_t scratch_size() const { return 0; }

    void reset(std::byte* state, Context<Scalar>& context) const {
        write(state, initial);
        if (faulty_reset) fault<bool>(context, {0, 0});
    }

    double step(const std::byte* state, const std::byte* action, std::byte*, std::byte* next,
                std::byte* observation, Context<Scalar>& context) const {
        const auto count = read(state);
        const double p = count >= faulty_from ? 2.0 : 0.5;
        sample::bernoulli(context, {0, 0}, p);
        write(next, count + read(action));
        write(observation, sample::normal(context, {1, 0}, to_real(count + read(action)), 1.0));
        return to_real(read(action));
    }
    bool terminal(const std::byte* state, Context<Scalar>& context) const {
        if (read(state) == faulty_terminal) fault<bool>(context, {0, 0});
        return read(state) >= terminal_from;
    }
    bool violates_invariant(const std::byte* state, Context<Scalar>&) const {
        return read(state) >= forbidden_from;
    }
    // The action is not negative and not above 10.
    int violated_precondition(const std::byte*, const std::byte* action, Context<Scalar>&) const {
        return read(action) < 0 ? 0 : read(action) > 10 ? 1 : -1;
    }

    static std::int64_t read(const std::byte* record) {
        std::int64_t value;
        std::memcpy(&value, record, sizeof value);
        return value;
    }
    template <class Number>
    static void write(std::byte* record, Number value) {
        std::memcpy(record, &value, sizeof value);
    }
};
static_assert(Engine<CounterEngine>);

// Its records.
inline constexpr rddl_fluent counter_fluents[] = {
    {"count", RDDL_STATE, RDDL_INT, -1, 0, nullptr, 1, 0, nullptr, nullptr, {"counter.rddl", 1, 1}},
    {"move", RDDL_ACTION, RDDL_INT, -1, 0, nullptr, 1, 0, nullptr, nullptr, {"counter.rddl", 2, 1}},
    {"seen",
     RDDL_OBSERVATION,
     RDDL_REAL,
     -1,
     0,
     nullptr,
     1,
     0,
     nullptr,
     nullptr,
     {"counter.rddl", 3, 1}}};
inline constexpr rddl_problem counter_problem{.struct_size = sizeof(rddl_problem),
                                              .type_size = sizeof(rddl_type),
                                              .fluent_size = sizeof(rddl_fluent),
                                              .condition_size = sizeof(rddl_condition),
                                              .domain = "counter",
                                              .instance = "counter_1",
                                              .types = nullptr,
                                              .type_count = 0,
                                              .fluents = counter_fluents,
                                              .fluent_count = 3,
                                              .state_size = 8,
                                              .action_size = 8,
                                              .observation_size = 8,
                                              .interm_size = 0,
                                              .partially_observed = 1,
                                              .stochastic = 1,
                                              .default_action = nullptr,
                                              .horizon = 0,
                                              .discount = 1.0,
                                              .max_nondef_actions = -1,
                                              .preconditions = nullptr,
                                              .precondition_count = 0,
                                              .invariants = nullptr,
                                              .invariant_count = 0,
                                              .terminations = nullptr,
                                              .termination_count = 0,
                                              .fingerprint = 0};

}  // namespace rddl
