// An episode in the terminal.
#pragma once

#include "pictures/outputs.hpp"

namespace rddlc::workbench {

// State by state in place, as text, or as pictures where the terminal shows some, each for as long
// as the pace says. What is no terminal gets the states at once as text, one below the other.
Output watch_output(const PictureOptions& options);

}  // namespace rddlc::workbench
