// The report of `rddl bench`, for people and for programs.
#pragma once

#include "engines/load_simulator.hpp"
#include "measure/measurement.hpp"
#include "measure/peers.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rddlc::workbench {

struct BenchReport {
    std::string problem;
    Engine engine = Engine::Compiled;
    RealType real = RealType::Double;
    int lanes = 1;                // of the simulator's packs of environments
    std::string instruction_set;  // that these are made for
    LoadCosts costs;
    std::optional<double> first_step_seconds;      // from the files; nothing if the simulator was
                                                   // taken from the cache
    std::optional<double> memory_per_environment;  // bytes, in the largest batch
    std::vector<Measurement> measurements;         // one environment, then batches
    std::int64_t episodes = 0;                     // that ended while actions were drawn for these
    std::int64_t faulted = 0;                      // of which a fault ended so many
    std::vector<PeerFigures> peers;
};

void print_table(const BenchReport& report);
void print_json(const BenchReport& report);

}  // namespace rddlc::workbench
