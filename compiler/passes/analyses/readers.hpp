// The readers of the interm- and derived-fluents of a step, and how often they read.
#pragma once

#include "ir/ir.hpp"

#include <set>
#include <vector>

namespace rddlc::passes {

struct Readers {
    // How many elements are read in one step, if each statement reads an element once wherever it
    // needs it.
    double reads = 0;
    double places = 0;              // how often a load of it stands in the text
    int definitions = 0;            // how many read it; and the reward, if it does
    bool lazy = false;              // some of them are in a branch or in the body of an aggregation
    std::vector<ir::NodeId> loads;  // all of them, each once
    std::set<ir::VariableId> variables;  // bound in the definitions that read it
    bool functions = false;              // external or matrix functions take or overwrite it
};

// The reads of the step and the reward, by BufferId::index.
std::vector<Readers> readers_of_step(const ir::Program& program);

// The variables that the node, or anything below it, binds.
std::set<ir::VariableId> bound_variables(const ir::Program& program, ir::NodeId id);

}  // namespace rddlc::passes
