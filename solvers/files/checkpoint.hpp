// How checkpoints of all solvers begin: with what they are of.
#pragma once

#include "solvers/files/archive.hpp"
#include "solvers/files/fingerprint.hpp"

#include <cstdint>
#include <string>

namespace rddlc::solvers {

struct CheckpointKind {
    std::string solver;     // "PPO", as messages have it
    std::string magic;      // the first bytes
    std::uint64_t version;  // of what follows; another one is refused
};

void begin_checkpoint(SavingArchive& archive, const CheckpointKind& kind,
                      const Fingerprint& problem);
// Throws a Failure where it is of another kind, version or problem.
void begin_checkpoint(LoadingArchive& archive, const CheckpointKind& kind,
                      const Fingerprint& problem);

}  // namespace rddlc::solvers
