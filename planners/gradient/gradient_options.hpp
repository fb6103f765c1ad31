// Options of plan:gradient.
#pragma once

#include "planners/planner/common_options.hpp"

#include <optional>

namespace rddlc::planners {

// All: some plans follow each of the three kinds of derivatives.
enum class Relaxed { All, Soft, Straight, Exact };

struct GradientOptions : CommonOptions {
    std::optional<int> plans;      // that are improved side by side, by each relaxation
    std::optional<int> scenarios;  // draws of luck for each
    double rate = 0.1;             // of ascent, in half widths of bounds
    double spread = 0.5;           // of the first plans, in half widths of bounds
    std::int64_t replan = 1;       // steps that are made by one plan
    Relaxed relaxed = Relaxed::All;
    double sharpness = 10;  // of sigmoids in place of comparisons
};

const solvers::OptionTable<GradientOptions>& gradient_option_table();

}  // namespace rddlc::planners
