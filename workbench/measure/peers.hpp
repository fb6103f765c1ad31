// Other simulators of RDDL, measured by Python programs of ours (benchmarks/peers/).
#pragma once

#include "measure/measurement.hpp"
#include "problems/problem_lookup.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rddlc::workbench {

struct PeerFigures {
    std::string name;               // "pyRDDLGym-jax"
    std::string version;            // "3.1"
    double import_seconds = 0;      // of its Python packages
    double first_step_seconds = 0;  // then, from the files to the end of the first step
    std::vector<Measurement> measurements;
};

// The values of `--against`.
const std::vector<std::string>& peer_names();
// Whether the peer makes use of more than one core.
bool knows_threads(std::string_view name);

struct PeerOptions {
    std::string python;  // the interpreter; empty: that of $VIRTUAL_ENV, else python3
    double seconds = 1;  // of each measurement
    int cores = 1;       // that it may use
};

// Runs the program of that name while nothing else runs here. Fails if Python or the package is
// missing, or if the peer cannot run the problem.
PeerFigures measure_peer(std::string_view name, const ProblemFiles& files,
                         const PeerOptions& options);

}  // namespace rddlc::workbench
