#include "trace.hpp"

#include "../conformance/stepping.hpp"
#include "formats/records_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <vector>

namespace rddlc::testing {
namespace {

constexpr int steps = 8;
constexpr std::uint64_t seed = 42;

using Record = std::vector<std::byte>;

// Small numbers that look arbitrary, one for each step and value.
std::uint64_t scrambled(std::uint64_t step, std::uint64_t value) {
    std::uint64_t x = (step * 1000003 + value + 1) * 0x9e3779b97f4a7c15;
    x ^= x >> 31;
    return (x * 0xbf58476d1ce4e5b9) >> 33;
}

double real_between(double lower, double upper, std::uint64_t number) {
    const double low = std::isfinite(lower) ? lower : -1.0;
    const double high = std::isfinite(upper) ? upper : low + 2.0;
    return low + (high - low) * static_cast<double>(number % 5) / 4.0;
}

// One value in three is not the default; at most one where the problem limits their number.
Record action_at(const rddl_problem& problem, const workbench::RecordLayout& layout, int step) {
    Record record(layout.size());
    if (record.empty()) return record;
    std::memcpy(record.data(), problem.default_action, record.size());
    std::uint64_t value = 0;
    for (const workbench::RecordEntry& entry : layout.entries()) {
        const std::uint64_t number = scrambled(static_cast<std::uint64_t>(step), value++);
        if (number % 3 != 0) continue;
        std::byte* const target = record.data() + entry.offset;
        const rddl_fluent& fluent = *entry.fluent;
        const auto write = [&](auto element) {
            std::memcpy(target, &element, sizeof element);
        };
        if (fluent.scalar == RDDL_BOOL) {
            write(std::uint8_t{1});
        } else if (fluent.scalar == RDDL_INT) {
            const std::int64_t choices = entry.objects ? entry.objects->object_count : 3;
            write(static_cast<std::int64_t>(number / 3) % choices);
        } else {
            const double lower = fluent.lower ? fluent.lower[entry.grounding] : -1.0;
            const double upper = fluent.upper ? fluent.upper[entry.grounding] : 1.0;
            write(real_between(lower, upper, number / 3));
        }
        if (problem.max_nondef_actions >= 0) break;
    }
    return record;
}

std::string ending(std::uint8_t causes) {
    std::string text;
    if (causes & RDDL_TERMINATED) text += " terminated";
    if (causes & RDDL_TRUNCATED_HORIZON) text += " horizon";
    if (causes & RDDL_TRUNCATED_INVARIANT) text += " invariant";
    if (causes & RDDL_FAULTED) text += " fault";
    return text;
}

// Where many choose nothing: in the first step all, then all but one; and many single tables.
void forget_choices(const rddl_problem& problem, std::size_t environment, int step,
                    Record& action) {
    constexpr std::size_t chooser = 5;
    const bool forgets_all = step == 0 || (step == 1 && environment != chooser);
    for (std::int32_t i = 0; i < problem.fluent_count; ++i) {
        const rddl_fluent& fluent = *rddl_fluent_at(&problem, i);
        if (fluent.role != RDDL_ACTION || fluent.scalar != RDDL_BOOL) continue;
        const auto number = static_cast<std::size_t>(i) + environment;
        if (forgets_all || (step < steps / 2 && number % 3 != 0))
            std::memset(action.data() + fluent.offset, 0, static_cast<std::size_t>(fluent.count));
    }
}

stepping::Bytes actions_at(const rddl_problem& problem, std::size_t environments, int step) {
    const workbench::RecordLayout layout(problem, RDDL_ACTION);
    stepping::Bytes actions(environments * layout.size() + 1);
    for (std::size_t i = 0; i < environments && layout.size() > 0; ++i) {
        Record action = action_at(problem, layout, step + static_cast<int>(i) * steps);
        forget_choices(problem, i, step, action);
        std::memcpy(actions.data() + i * layout.size(), action.data(), action.size());
    }
    return actions;
}

// One nan is like another.
void make_nans_equal(stepping::Bytes& records, const workbench::RecordLayout& layout) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const std::size_t count = layout.size() == 0 ? 0 : records.size() / layout.size();
    for (std::size_t i = 0; i < count; ++i) {
        for (const workbench::RecordEntry& entry : layout.entries()) {
            std::uint8_t* const at = records.data() + i * layout.size() + entry.offset;
            double real = 0;
            if (entry.fluent->scalar != RDDL_REAL) continue;
            std::memcpy(&real, at, sizeof real);
            if (std::isnan(real)) std::memcpy(at, &nan, sizeof nan);
        }
    }
}

void step_batch(stepping::ObservedBatch& batch, const stepping::Bytes& actions) {
    const rddl_problem& problem = *batch.simulator().problem;
    batch.step(actions);
    const workbench::RecordLayout state(problem, RDDL_STATE);
    const workbench::RecordLayout seen(problem,
                                       problem.partially_observed ? RDDL_OBSERVATION : RDDL_STATE);
    make_nans_equal(batch.told.states, state);
    make_nans_equal(batch.told.observations, seen);
    make_nans_equal(batch.told.final_observations, seen);
}

}  // namespace

std::string difference_in_batches(const rddl_simulator& expected, const rddl_simulator& found) {
    constexpr std::size_t environments = 19;  // a pack and a part of one
    stepping::ObservedBatch first(expected, environments, 1, 1);
    stepping::ObservedBatch single(found, environments, 1, 1);
    stepping::ObservedBatch packs(found, environments, found.lane_count, 1);
    for (int step = 0; step < steps; ++step) {
        const stepping::Bytes actions = actions_at(*expected.problem, environments, step);
        for (stepping::ObservedBatch* const batch : {&first, &single, &packs})
            step_batch(*batch, actions);
        for (const stepping::ObservedBatch* const other : {&single, &packs})
            if (const char* const what = stepping::difference(first.told, other->told))
                return fmt::format("{} differ in step {} of {}", what, step,
                                   other == &packs ? "packs" : "single environments");
    }
    return "";
}

std::string trace_of(const rddl_simulator& simulator) {
    const rddl_problem& problem = *simulator.problem;
    const workbench::RecordLayout state_layout(problem, RDDL_STATE);
    const workbench::RecordLayout action_layout(problem, RDDL_ACTION);
    const workbench::RecordLayout observation_layout(problem, RDDL_OBSERVATION);
    Record state(state_layout.size()), observation(observation_layout.size());

    rddl_batch_options options{};
    options.seed = seed;
    options.thread_count = 1;
    rddl_batch* const batch = simulator.create(&simulator, &options);
    if (!batch) return "no batch\n";

    std::string text = "state ";
    simulator.get_state(batch, 0, 1, state.data());
    state_layout.write(text, state.data());
    text += "\n";
    std::uint8_t causes = RDDL_RUNNING;
    for (int step = 0; step < steps && causes == RDDL_RUNNING; ++step) {
        Record action = action_at(problem, action_layout, step);
        if (simulator.policy) simulator.policy_act(batch, action.data());
        double reward = 0;
        rddl_transition out{};
        out.observations = observation.data();
        out.rewards = &reward;
        out.causes = &causes;
        const rddl_error error = simulator.step(batch, action.data(), &out);
        if (error != RDDL_OK) {
            text += fmt::format("error {}\n", static_cast<int>(error));
            break;
        }
        text += "action ";
        action_layout.write_changes(text, action.data(),
                                    static_cast<const std::byte*>(problem.default_action));
        simulator.get_state(batch, 0, 1, state.data());
        text += "\n  state ";
        state_layout.write(text, state.data());
        if (problem.partially_observed) {
            text += "\n  observation ";
            observation_layout.write(text, observation.data());
        }
        text += fmt::format("\n  reward {}{}\n", reward, ending(causes));
    }
    rddl_fault fault{};
    if (simulator.get_fault(batch, 0, &fault) == RDDL_OK && fault.faulty) {
        text += fmt::format("fault in step {}: {}\n", fault.step, fault.message);
    }
    simulator.destroy(batch);
    return text;
}

}  // namespace rddlc::testing
