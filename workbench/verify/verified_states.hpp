// States to step from that no episode may reach by itself.
#pragma once

#include "formats/records_json.hpp"
#include "rollouts/step_outcome.hpp"

#include <rddl/simulator.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <random>
#include <vector>

namespace rddlc::workbench {

// Random states: some values of a state are replaced by others of their type, within the bounds of
// the problem or, without bounds, within the range seen so far, bounds themselves often.
class RandomStates {
  public:
    // `layout` must outlive this.
    RandomStates(const RecordLayout& layout, std::uint64_t seed);

    // Widens the ranges of ints and reals.
    void see(const Record& state);
    // Replaces in some calls few values, in others many.
    void shake(Record& state);

  private:
    struct Range {
        double low, high;    // what was seen; low > high: nothing yet
        double least, most;  // the problem's bounds, which may be infinite
    };

    bool happens(double probability);
    double between(double low, double high);
    double number(const Range& range);
    void shake(Record& state, std::size_t entry);

    const RecordLayout& layout_;
    std::mt19937_64 random_;
    std::vector<Range> ranges_;  // by entry
};

// A state of a file, and the action that was taken there, if the file has one.
struct RecordedState {
    Record state;
    std::optional<Record> action;
};

// The steps of a trace or of an input of `rddl replay` (docs/traces.md). A part of a state is one
// of the initial state. Fails where a line is not one, or has no state.
std::vector<RecordedState> read_states(const std::filesystem::path& file,
                                       const rddl_problem& problem, const Record& initial_state);

}  // namespace rddlc::workbench
