#include "rollouts/step_outcome.hpp"

#include "formats/trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace rddlc::workbench {

namespace {

double real_at(const Record& record, const RecordEntry& entry) {
    return value_at<double>(record.data(), entry);
}

bool same_bytes(const RecordEntry& entry, const Record& a, const Record& b) {
    const std::size_t size = scalar_size(entry.fluent->scalar);
    return std::memcmp(a.data() + entry.offset, b.data() + entry.offset, size) == 0;
}

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

std::string real_text(double value) {
    std::string text;
    write_real(text, value);
    return text;
}

std::string value_text(const RecordEntry& entry, const Record& record) {
    std::string text;
    write_value(text, entry, record.data());
    return text;
}

std::string fault_words(const std::string& fault) {
    return fault.empty() ? "no fault" : fault;
}

std::string ending_words(std::uint8_t causes) {
    return causes == RDDL_RUNNING ? "the episode continues"
                                  : "the episode ends: " + causes_json(causes);
}

// Counts reals that are accepted without being the same.
bool accept(double expected, double found, Tolerance tolerance, ValueCounts& counts) {
    if (!tolerance.accepts(expected, found)) return false;
    if (same_bits(expected, found) || (std::isnan(expected) && std::isnan(found))) return true;
    ++counts.rounded;
    if (std::isfinite(expected))
        counts.largest_rounding =
            std::max(counts.largest_rounding, relative_difference(expected, found));
    return true;
}

// Whether different last digits explain the difference.
bool is_explained(double expected, double found, const std::vector<double>& otherwise) {
    double least = found, most = found;
    for (const double other : otherwise) {
        if (std::isnan(other) && std::isnan(expected)) return true;
        least = std::fmin(least, other);  // a number, where the other one is nan
        most = std::fmax(most, other);
    }
    const double reach = std::max(found - least, most - found);
    return (least <= expected && expected <= most) || std::abs(expected - found) <= reach;
}

bool is_explained(const RecordEntry& entry, const Record& expected, const Record& found,
                  const std::vector<const Record*>& otherwise) {
    if (entry.fluent->scalar != RDDL_REAL)
        return std::ranges::any_of(
            otherwise, [&](const Record* other) { return same_bytes(entry, expected, *other); });
    std::vector<double> reals;
    for (const Record* other : otherwise) reals.push_back(real_at(*other, entry));
    return is_explained(real_at(expected, entry), real_at(found, entry), reals);
}

}  // namespace

double relative_difference(double a, double b) {
    if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
    if (!std::isfinite(a) || !std::isfinite(b)) return std::numeric_limits<double>::infinity();
    return std::abs(a - b) / std::max(std::abs(a), std::abs(b));
}

bool Tolerance::accepts(double expected, double found) const {
    if (same_bits(expected, found) || (std::isnan(expected) && std::isnan(found))) return true;
    if (of_reals == 0) return false;
    if (only_finite && !std::isfinite(expected)) return true;
    return relative_difference(expected, found) <= of_reals;
}

OutcomeComparison::OutcomeComparison(const rddl_problem& problem)
    : problem_(problem),
      state_(problem, RDDL_STATE),
      action_(problem, RDDL_ACTION),
      observation_(problem, RDDL_OBSERVATION) {}

std::optional<Difference> OutcomeComparison::compare(const StepOutcome& expected,
                                                     const StepOutcome& found, Tolerance tolerance,
                                                     ValueCounts& counts,
                                                     std::span<const StepOutcome> otherwise) const {
    const auto any_other = [&](auto StepOutcome::*part) {
        return std::ranges::find(otherwise, expected.*part, part) != otherwise.end();
    };
    const auto others = [&](Record StepOutcome::*record) {
        std::vector<const Record*> records;
        for (const StepOutcome& other : otherwise)
            if (other.fault.empty()) records.push_back(&(other.*record));
        return records;
    };
    const auto states = [&] {
        return compare_records(Shown::State, state_, expected.state, found.state, tolerance, counts,
                               others(&StepOutcome::state));
    };
    if (expected.causes_before != found.causes_before)
        return Difference{
            Shown::Start, "the episode before the step",        {},
            {},           ending_words(expected.causes_before), ending_words(found.causes_before)};
    if (expected.causes_before != RDDL_RUNNING) return states();
    if (expected.action && found.action)
        if (auto difference = compare_records(Shown::Action, action_, *expected.action,
                                              *found.action, tolerance, counts, {}))
            return difference;
    if (expected.violated_precondition != found.violated_precondition &&
        !any_other(&StepOutcome::violated_precondition))
        return precondition(expected.violated_precondition, found.violated_precondition);
    if (expected.fault != found.fault)
        return Difference{Shown::Fault,
                          "the fault",
                          {},
                          {},
                          fault_words(expected.fault),
                          fault_words(found.fault)};
    if (auto difference = states()) return difference;
    if (expected.fault.empty()) {
        if (auto difference = compare_records(Shown::Observation, observation_,
                                              expected.observation, found.observation, tolerance,
                                              counts, others(&StepOutcome::observation)))
            return difference;
        std::vector<double> rewards;
        for (const StepOutcome& other : otherwise) rewards.push_back(other.reward);
        if (!accept(expected.reward, found.reward, tolerance, counts) &&
            !is_explained(expected.reward, found.reward, rewards))
            return Difference{
                Shown::Reward,          "the reward", {}, {}, real_text(expected.reward),
                real_text(found.reward)};
    }
    if (expected.causes != found.causes && !any_other(&StepOutcome::causes))
        return Difference{Shown::Ending,
                          "the end of the episode",
                          {},
                          {},
                          ending_words(expected.causes),
                          ending_words(found.causes)};
    return std::nullopt;
}

std::optional<Difference> OutcomeComparison::compare_records(
    Shown what, const RecordLayout& layout, const Record& expected, const Record& found,
    Tolerance tolerance, ValueCounts& counts, const std::vector<const Record*>& otherwise) const {
    if (expected == found) return std::nullopt;
    for (const RecordEntry& entry : layout.entries()) {
        const bool same =
            entry.fluent->scalar == RDDL_REAL
                ? accept(real_at(expected, entry), real_at(found, entry), tolerance, counts)
                : same_bytes(entry, expected, found);
        if (same || is_explained(entry, expected, found, otherwise)) continue;
        return Difference{what,
                          name_of(what, entry),
                          static_cast<std::int32_t>(entry.fluent - problem_.fluents),
                          {},
                          value_text(entry, expected),
                          value_text(entry, found)};
    }
    return std::nullopt;
}

// The name as in RDDL: "water'(t1)".
std::string OutcomeComparison::name_of(Shown what, const RecordEntry& entry) const {
    const rddl_fluent& fluent = *entry.fluent;
    std::string arguments;
    std::int64_t rest = entry.grounding;
    for (std::int32_t k = fluent.rank; k-- > 0;) {
        const rddl_type& type = problem_.types[fluent.parameter_types[k]];
        arguments =
            type.objects[rest % type.object_count] + (arguments.empty() ? "" : ", " + arguments);
        rest /= type.object_count;
    }
    return fmt::format("{}{}{}", fluent.name, what == Shown::State ? "'" : "",
                       arguments.empty() ? "" : "(" + arguments + ")");
}

Difference OutcomeComparison::precondition(std::int32_t expected, std::int32_t found) const {
    const auto words = [](std::int32_t violated) {
        return violated < 0 ? std::string("all hold")
                            : fmt::format("number {} is violated first", violated + 1);
    };
    const std::int32_t first = expected < 0 ? found
                               : found < 0  ? expected
                                            : std::min(expected, found);
    return {Shown::Precondition, "the preconditions", {}, first, words(expected), words(found)};
}

void OutcomeComparison::count(const StepOutcome& outcome, ValueCounts& counts) const {
    const auto size = [](const RecordLayout& layout) {
        return static_cast<std::int64_t>(layout.entries().size());
    };
    counts.states += size(state_);
    if (outcome.causes_before != RDDL_RUNNING) return;
    if (outcome.action) counts.actions += size(action_);
    counts.conditions += (problem_.precondition_count > 0) + (problem_.invariant_count > 0) +
                         (problem_.termination_count > 0);
    counts.faults += 1;
    if (!outcome.fault.empty()) return;
    counts.rewards += 1;
    if (problem_.partially_observed) counts.observations += size(observation_);
}

}  // namespace rddlc::workbench
