// A simulator that starts interpreted and changes to the compiled engine when that is ready.
#pragma once

#include "engines/background_build.hpp"

#include <rddl/simulator.h>

#include <memory>

namespace rddlc::workbench {

// Its batches are stepped by the interpreter, and move to the compiled simulator, in the middle of
// their episodes, at the beginning of the first call that may change them once that is there. Both
// compute the same bits, so nothing else shows it: the description is the interpreter's. A batch
// that cannot move for lack of memory stays. The build is stopped with the simulator.
std::shared_ptr<const rddl_simulator> switching_simulator(
    std::shared_ptr<const rddl_simulator> interpreted, std::shared_ptr<BackgroundBuild> compiled);

}  // namespace rddlc::workbench
