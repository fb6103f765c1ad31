// Files that users give beside RDDL, read as the programs read them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::fuzzing {

enum class FileKind { Policy, PpoCheckpoint, CgpCheckpoint, Trace, Scene, Run, Curves };
inline constexpr std::size_t file_kinds = 7;

// The readers of all kinds, for one small problem. `problem` is its file; programs of scikit-decide
// are for a problem without objects, the folder `plain`. Files are written to `folder` on the way.
class FileReaders {
  public:
    FileReaders(const std::filesystem::path& problem, const std::filesystem::path& plain,
                std::filesystem::path folder);
    ~FileReaders();
    FileReaders(const FileReaders&) = delete;
    FileReaders& operator=(const FileReaders&) = delete;

    // Reads the file, and does with it what the commands do: plays, exports, draws, resumes. True
    // if it was accepted, false if a Failure with a sentence refused it; every other exception,
    // also a lack of memory, is a bug of the reader.
    bool read(FileKind kind, std::string_view bytes);

    // Files of the kind that are accepted.
    std::vector<std::string> examples(FileKind kind) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rddlc::fuzzing
