// The effects of the passes in one compilation: `rddlc --stats`.
#pragma once

#include "passes/passes.hpp"

#include <string>
#include <vector>

namespace rddlc {

// A table: a line for each run of a pass, what it did, nodes and operations that are left, time.
// `runs` are never empty, since choose_evaluation always runs.
std::string statistics_text(const std::vector<PassRun>& runs);
// An array of objects with the members pass, did, nodes, operations and milliseconds.
std::string statistics_json(const std::vector<PassRun>& runs);

}  // namespace rddlc
