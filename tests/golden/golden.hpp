// Golden files: expected text that one command accepts anew.
#pragma once

#include <filesystem>
#include <string>

namespace rddlc::testing {

// The differences as `diff -u` writes them, without a header; empty if the texts are equal.
std::string unified_diff(const std::string& expected, const std::string& actual);

// Fails the running test, with the differences and how to accept them, unless the file holds
// `actual`. With RDDLC_UPDATE=1 in the environment, writes the file instead. `test` is what
// `ctest -R` takes.
void expect_golden(const std::filesystem::path& file, const std::string& actual,
                   const std::string& test);

}  // namespace rddlc::testing
