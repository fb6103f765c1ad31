// A state in words, a line for each fluent or value: for the text visualizer, and for terminals.
#pragma once

#include "render/snapshot.hpp"

#include <string>
#include <vector>

namespace rddl::render {

struct TextLine {
    std::string name;   // "rlevel(t1)", or "running" of a bool fluent with parameters
    std::string value;  // "53.2", "c1 c4 c7"
    bool changed;       // since the step before
};

// One line lists the objects for which a bool with parameters is true.
std::vector<TextLine> state_lines(const Snapshot& snapshot);

// "reboot(c1), throttle = 0.5": what differs from the default; "default" where nothing does.
std::string action_text(const Snapshot& snapshot);

}  // namespace rddl::render
