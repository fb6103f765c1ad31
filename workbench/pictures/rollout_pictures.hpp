// Pictures of episodes while they run.
#pragma once

#include "pictures/picture_writer.hpp"
#include "solvers/evaluation/episodes.hpp"

#include <string_view>

namespace rddlc::workbench {

// Draws the lines of a trace, each with its line break.
void draw_lines(std::string_view lines, PictureWriter& pictures);

// Draws the state of each episode that is over before its first step, and so has no line in the
// trace.
void draw_initial_states(const solvers::Rollouts& rollouts, PictureWriter& pictures);

}  // namespace rddlc::workbench
