// One process at a time makes what all share; the others wait for it.
#pragma once

#include <filesystem>

namespace rddlc::workbench {

// Held from the construction on by a lock on the folder, which the system releases when a process
// ends in any way. A process that cannot lock, or has waited for two minutes, continues without it:
// the same is then made twice, which does no harm.
class BuildersTurn {
  public:
    // Reports on a terminal that it waits. Fails on an interrupt.
    explicit BuildersTurn(const std::filesystem::path& folder);
    ~BuildersTurn();
    BuildersTurn(const BuildersTurn&) = delete;
    BuildersTurn& operator=(const BuildersTurn&) = delete;

  private:
    int descriptor_;
};

}  // namespace rddlc::workbench
