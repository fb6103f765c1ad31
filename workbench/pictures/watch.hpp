// An episode in the terminal.
#pragma once

#include "pictures/outputs.hpp"

namespace rddlc::workbench {

// Shows state by state in place, as text, or as pictures if the terminal can, each for as long as
// the pace says. Outputs other than terminals get the states at once as text, one below the other.
Output watch_output(const PictureOptions& options);

}  // namespace rddlc::workbench
