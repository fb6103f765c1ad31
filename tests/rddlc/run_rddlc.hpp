// Calls of rddlc in a folder of their own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace rddlc::testing {

struct Result {
    int status;
    std::string output;  // standard output and error
};

// The test runs in an empty folder that holds domain.rddl and instance.rddl; it is removed at the
// end.
class RddlcTest : public ::testing::Test {
  protected:
    RddlcTest();
    ~RddlcTest() override;

    Result rddlc(const std::vector<std::string>& arguments) const;
    // Runs it with environment variables, such as "CXX=none", before the program.
    Result rddlc_with(const std::vector<std::string>& environment,
                      const std::vector<std::string>& arguments) const;

    static void write(const std::filesystem::path& file, const std::string& text);
    static std::string read(const std::filesystem::path& file);
    // The names in the working folder, hidden ones included.
    static std::vector<std::string> files();

  private:
    std::filesystem::path before_;
    std::filesystem::path folder_;
};

}  // namespace rddlc::testing
