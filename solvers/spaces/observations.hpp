// The observations of a learner: a row of floats for each environment.
#pragma once

#include <rddl/simulator.h>

#include <cstdint>
#include <string>
#include <vector>

namespace rddlc::solvers {

// Observations that may be seen at once.
inline constexpr int most_stacked = 1000;

struct ObservationOptions {
    enum class Time { Auto, On, Off } time = Time::Auto;
    int stack = 1;  // observations that are seen at once, the newest first
};

// Auto shows the time in episodes of at most this many steps: what is best to do depends on the
// steps that are left.
inline constexpr std::int64_t longest_horizon_with_time = 200;

struct ObservationSpace {
    // Bools are 0 and 1, objects one feature for each object (1 for the one that it is), numbers
    // themselves.
    struct Column {
        std::string name;  // "rlevel(t1)"
        int first_feature = 0;
        int object_count = 0;  // 0: a number
        rddl_scalar scalar = RDDL_REAL;
        double lower = 0, upper = 0;
    };
    std::vector<Column> columns;
    std::vector<std::string> features;  // names of one observation's; objects as "at(i1)=n2"
    bool has_objects = false;
    bool time = false;         // the last feature of the row: steps made / horizon, in [0, 1]
    std::int64_t horizon = 0;  // that it is measured by
    int stack = 1;

    int column_count() const { return static_cast<int>(columns.size()); }
    int frame_size() const { return static_cast<int>(features.size()); }
    int feature_count() const { return stack * frame_size() + (time ? 1 : 0); }
};

ObservationSpace observation_space(const rddl_simulator& simulator,
                                   const ObservationOptions& options);

// The name of a value for readers: "rlevel(t1)", "turn".
std::string grounded_name(const rddl_simulator& simulator, std::int32_t fluent,
                          std::int64_t grounding);

// Turns a simulator's row of values into the features of the row. `features` holds those of the
// episode's last observation, which move on. If the episode `begins`, the older ones become 0.
void write_features(const ObservationSpace& space, const float* values, std::int64_t steps,
                    bool begins, float* features);

}  // namespace rddlc::solvers
