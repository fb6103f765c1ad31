// Every pass is held to its contract: the IR stays valid, and the plain interpreter finds the same
// before and after it.
#pragma once

#include "passes/passes.hpp"
#include "twins.hpp"

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::fuzzing {

// The changes of values that the header of a pass allows.
Tolerance tolerance_of(std::string_view pass);

// A pass that broke its contract, and how.
struct Breach {
    std::string pass;
    std::string text;
};

struct Contracts {
    ir::Program optimised;
    std::map<std::string, int> changed;  // how many runs of a pass changed something
    std::vector<Breach> breaches;
};

// Optimises a valid program, and checks it after each pass. The contracts are tested one by one:
// each pass beside the one before it, for that many steps at most; not at all if that is 0. Throws
// what the passes throw.
Contracts check_contracts(const ir::Program& program, const PassOptions& options, Values values,
                          std::uint64_t seed, int steps);

}  // namespace rddlc::fuzzing
