// How a learner acts: what it chooses from, and which action that makes.
//
// Reals are numbers of their own scale, in which noise of deviation 1 is a lot and 0 a middle
// value; bools, objects and ints of few values are categories. Where preconditions allow bools to
// change one at a time, such as one item for each consumer, one category says which
// (preconditions.hpp).
// Either each category is chosen by itself, or an action is a sequence of sub-actions (an
// autoregressive action): each of them chooses one change of the default action, or to stop. So it
// is where max-nondef-actions allows few changes, or preconditions couple them in another way. Each
// sub-action knows, from the simulator, which changes are legal after those that were made.
#pragma once

#include "solvers/batches/stops.hpp"
#include "solvers/spaces/groups.hpp"

#include <rddl/simulator.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

namespace rddlc::solvers {

// A number u of the learner's, and the value of a real (or of an int of many values):
struct RealHead {
    enum class Range { Bounded, Squashed, AboveLower, BelowUpper, Free } range = Range::Free;
    int column = 0;
    bool rounds = false;          // an int
    double lower = 0, upper = 0;  // of Bounded: the middle for u = 0, the bounds for -1 and 1
    // Squashed: the same of tanh(u), which never leaves the bounds.
    // The others: lower + scale * softplus(u), or centre + scale * u, where centre is the default.
    double scale = 1, centre = 0;
    int choice = -1;  // with sub-actions: the choice that sets it

    // Values are limited to the bounds; in a direction without one to 1e9, or to twice the other
    // bound or the default where that is more.
    double least() const {
        return limit(lower, std::min({-1e9, 2 * upper, -2 * std::abs(centre)}));
    }
    double most() const { return limit(upper, std::max({1e9, 2 * lower, 2 * std::abs(centre)})); }

  private:
    // Ints stay within 64 bits, also when they are rounded to a float.
    double limit(double bound, double otherwise) const {
        const double found = std::isfinite(bound) ? bound : otherwise;
        return rounds ? std::clamp(found, -9e18, 9e18) : found;
    }
};

// The values of a bool, an object or an int; or which bool of a group changes.
struct CategoryHead {
    int column = 0;  // of a group: its first one
    int first_logit = 0;
    int count = 0;
    std::int64_t first_value = 0;
    std::vector<int> group{};  // columns of bools: 0 changes no bool, k changes group[k - 1]
};

// One change of the default action.
struct Choice {
    int column = -1;            // -1: no column, to stop
    std::int64_t value = 0;     // of a category
    int real = -1;              // or the real head whose number it takes
    std::int64_t of_mask = -1;  // the simulator's number of this choice; -1: always allowed
};

struct ActionSpace {
    int column_count = 0;
    std::vector<float> defaults;     // column_count
    std::vector<std::string> names;  // column_count, "release(t1)"
    std::vector<RealHead> reals;
    std::vector<CategoryHead> categories;  // empty with sub-actions
    std::vector<Choice> choices;           // of each sub-action; the first one stops
    int max_sub_actions = 0;               // 0: each category is chosen by itself
    int logit_count = 0;
    bool masked = false;          // a mask says which logits are allowed
    bool asks = true;             // the simulator makes it, unless that would take too long
    bool may_be_illegal = false;  // the chosen action may violate a precondition, and is repaired
    std::vector<int> logit_of_mask;  // of categories, by the simulator's choices: a logit, or -1

    int real_count() const { return static_cast<int>(reals.size()); }
    // Numbers that say what was chosen besides reals: categories, or the choice of each sub-action
    // (-1: stopped before).
    int index_count() const {
        return max_sub_actions > 0 ? max_sub_actions : static_cast<int>(categories.size());
    }
    // The means of reals, then the logits.
    int output_count() const { return real_count() + logit_count; }
    // Bytes that say for each logit, and for each sub-action if there are any, whether it
    // was allowed.
    int mask_size() const { return masked ? logit_count * std::max(max_sub_actions, 1) : 0; }
};

// Throws a Failure where the problem has no actions that differ from each other, or too many
// choices. Makes no step.
void require_choices(const rddl_simulator& simulator);

// Finds the space from the problem, and by a few random steps what its preconditions forbid. Throws
// as require_choices does. Ends early if `stops` says so.
ActionSpace action_space(const rddl_simulator& simulator, const Stops& stops = {});

// The groups of bools that preconditions allow one change each (preconditions.hpp), if all of them
// may change in one action. Nothing where the problem has fewer bools than `least_bools`: then
// nothing is tried.
std::optional<Groups> groups_without_limit(const rddl_simulator& simulator, int least_bools,
                                           const Stops& stops = {});

// The columns of action values.
std::vector<rddl_column> action_columns(const rddl_simulator& simulator);

// Reals with two bounds become squashed.
void squash_bounded(ActionSpace& space);

// The value of a real for the learner's number.
double real_value(const RealHead& head, double number);

// Writes the row of column_count action values.
void write_action(const ActionSpace& space, const float* numbers, const std::int32_t* indices,
                  float* values);
// The inverse, as far as there is one: sub-actions come in the order of choices, and 0 stops them.
void read_action(const ActionSpace& space, const float* values, float* numbers,
                 std::int32_t* indices);

// Action rows as records and back. Constant for a problem. A value that is the default in the row's
// precision becomes the default itself: 0.1f is no change of 0.1. A real beyond its bounds becomes
// the bound: 0.1f lies above 0.1.
class ActionRecords {
  public:
    explicit ActionRecords(const rddl_simulator& simulator);
    void write(const float* values, std::byte* record) const;
    void read(const std::byte* record, float* values) const;
    std::size_t record_size() const { return record_size_; }

    // Where the value of a column stands in a record, and its default.
    struct Entry {
        std::size_t offset;
        rddl_scalar scalar;
        double lower, upper;  // of a real; infinite where it has no bound
        // Writes a value in the type that it has there: of an int a whole number, and a number
        // above 0.5 is true.
        void set(double value, std::byte* record) const;
    };
    const Entry& entry(int column) const { return entries_[static_cast<std::size_t>(column)]; }
    double default_value(int column) const;
    const std::vector<std::byte>& default_record() const { return blank_; }

  private:
    std::vector<Entry> entries_;
    std::vector<std::byte> blank_;  // the default action
    std::vector<float> defaults_;   // as a row
    std::size_t record_size_;
};

inline void ActionRecords::Entry::set(double value, std::byte* record) const {
    if (scalar == RDDL_BOOL) {
        record[offset] = static_cast<std::byte>(value > 0.5);
    } else if (scalar == RDDL_INT) {
        const auto number = static_cast<std::int64_t>(value);
        std::memcpy(record + offset, &number, sizeof number);
    } else {
        std::memcpy(record + offset, &value, sizeof value);
    }
}

}  // namespace rddlc::solvers
