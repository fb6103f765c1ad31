// Measures the cost of compiling a problem, its speed, and the speed of other simulators.
#pragma once

#include "engines/load_simulator.hpp"
#include "measure/bench_report.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace rddlc::workbench {

struct BenchSettings {
    double seconds = 1;                 // for each measurement
    std::vector<std::int64_t> batches;  // empty: one of a size that suits the problem
    int threads = 0;                    // the most to try; 0: one per core
    std::vector<std::string> against;   // other simulators (peer_names)
    std::string python;                 // that runs them
};

// Stops early on an interrupt, with what is measured.
BenchReport bench_problem(const ProblemFiles& files, LoadOptions load,
                          const BenchSettings& options);

}  // namespace rddlc::workbench
