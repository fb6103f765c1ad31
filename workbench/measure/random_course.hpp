// Actions for a batch, drawn beforehand, so that only stepping is measured.
#pragma once

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddlc::workbench {

// The options of batches to which a course belongs. Results do not depend on the number of threads
// or lanes, so neither do courses.
rddl_batch_options course_options(std::int64_t environments);

// Random legal actions of the first steps of a new batch. A caller that steps such a batch with
// them meets the states for which they were drawn; they are legal only then.
struct RandomCourse {
    std::int64_t environments = 0;
    std::int64_t steps = 0;
    std::vector<std::byte> actions;  // records by step, then by environment
    std::int64_t episodes = 0;       // that end within it,
    std::int64_t faulted = 0;        // and those of them that a fault ends

    const std::byte* of_step(std::int64_t step) const {
        return actions.data() +
               static_cast<std::size_t>(step) * (actions.size() / static_cast<std::size_t>(steps));
    }
};

// Enough steps that no branch predictor memorises them, if they fit in 64 MB and may be drawn in
// `seconds`; at least two.
RandomCourse draw_course(const rddl_simulator& simulator, std::int64_t environments,
                         double seconds);

}  // namespace rddlc::workbench
