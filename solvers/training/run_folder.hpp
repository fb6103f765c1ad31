// The lock of a run's folder.
#pragma once

#include <filesystem>

namespace rddlc::solvers {

// The folder of a run, which one process writes at a time.
class RunFolder {
  public:
    RunFolder() = default;
    ~RunFolder();
    RunFolder(const RunFolder&) = delete;
    RunFolder& operator=(const RunFolder&) = delete;

    // Throws a Failure where another process holds it. File systems without locks let all pass.
    void hold(const std::filesystem::path& folder);

  private:
    int descriptor_ = -1;
};

}  // namespace rddlc::solvers
