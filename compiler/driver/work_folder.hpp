// A folder of our own for output that is hidden until it is complete.
#pragma once

#include <filesystem>
#include <string>

namespace rddlc {

// Removed at the end. The next process that makes a folder at the same place removes those of
// killed ones: each process holds a lock on its own, which the system releases when it dies.
class WorkFolder {
  public:
    // Creates it in `parent`, which exists, with a name that begins with `prefix`; no other user
    // may enter it. Throws UnwritableFile with the advice `hint`.
    WorkFolder(const std::filesystem::path& parent, const std::string& prefix,
               const std::string& hint);
    ~WorkFolder();
    WorkFolder(const WorkFolder&) = delete;
    WorkFolder& operator=(const WorkFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    int lock_ = -1;
};

// A folder in $TMPDIR or /tmp.
class TemporaryFolder : public WorkFolder {
  public:
    TemporaryFolder();
};

}  // namespace rddlc
