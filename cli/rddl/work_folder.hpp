// A folder of our own beside the final place of what is made in it, so that a rename puts it there
// at once; removed at the end.
#pragma once

#include "failure.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>

namespace rddlc::cli {

class WorkFolder {
  public:
    explicit WorkFolder(const std::filesystem::path& parent) {
        std::error_code error;
        std::filesystem::create_directories(parent, error);
        std::string pattern = (parent / "building-XXXXXX").string();
        if (!mkdtemp(pattern.data()))
            throw Failure(
                fmt::format("cannot write to '{}': {}", parent.string(), std::strerror(errno)),
                "set XDG_CACHE_HOME to a folder that can be written");
        path_ = pattern;
    }
    ~WorkFolder() {
        std::error_code error;
        std::filesystem::remove_all(path_, error);
    }
    WorkFolder(const WorkFolder&) = delete;
    WorkFolder& operator=(const WorkFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace rddlc::cli
