// Files of a test.
#pragma once

#include "support/files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>

namespace rddlc::studio {

// A folder of this process, which ends with it.
class TestFolder {
  public:
    TestFolder()
        : path(std::filesystem::path(testing::TempDir()) /
               ("rddlc_studio_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(path);
    }
    ~TestFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    TestFolder(const TestFolder&) = delete;
    TestFolder& operator=(const TestFolder&) = delete;

    std::string write(const std::string& name, const std::string& text) const {
        UsedFiles used;
        write_file(path / name, text, used);
        return (path / name).string();
    }

    const std::filesystem::path path;
};

}  // namespace rddlc::studio
