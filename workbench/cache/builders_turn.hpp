// One process at a time makes what several need; the others wait for it.
#pragma once

#include <filesystem>
#include <stop_token>

namespace rddlc::workbench {

// Held from the construction on by a lock on a folder or a file, which the system releases when a
// process ends in any way. A process that cannot lock, or has waited for long, continues
// without it: the same is then made twice, which does no harm.
class BuildersTurn {
  public:
    // `place`: a folder, or a file, which is created if it does not exist. If a stop can be
    // requested, it waits without a word, for 20 minutes; otherwise for two, and reports on a
    // terminal that it waits. Fails on an interrupt, and on a stop.
    explicit BuildersTurn(const std::filesystem::path& place, const std::stop_token& stop = {});
    ~BuildersTurn();
    BuildersTurn(const BuildersTurn&) = delete;
    BuildersTurn& operator=(const BuildersTurn&) = delete;

  private:
    int descriptor_;
};

// Throws a Failure if a stop of what is built in the background is requested, and as
// give_up_if_interrupted does.
void give_up_if_stopped(const std::stop_token& stop);

}  // namespace rddlc::workbench
