// generated/NAME.cpp is what rddlc makes of examples/NAME: golden file, reading matter, and
// compiled by the build.
#include "driver/driver.hpp"
#include "golden.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace rddlc::testing {
namespace {

namespace fs = std::filesystem;

// The folders in examples/ that hold a problem.
std::vector<std::string> examples() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(fs::path(RDDLC_SOURCE_FOLDER) / "examples")) {
        if (fs::exists(entry.path() / "domain.rddl")) {
            names.push_back(entry.path().filename().string());
        }
    }
    std::ranges::sort(names);
    return names;
}

class Generated : public ::testing::TestWithParam<std::string> {};

TEST_P(Generated, IsWhatRddlcMakes) {
    fs::current_path(RDDLC_SOURCE_FOLDER);  // the text names its sources relative to here
    const fs::path folder = fs::path("examples") / GetParam();
    CompileOptions options;
    options.inputs = {folder / "domain.rddl", folder / "instance.rddl"};
    const fs::path output = fs::path("generated") / (GetParam() + ".cpp");
    options.output = output;
    options.stop_after = Stage::Emit;
    if (fs::exists(folder / "functions.hpp")) options.extern_headers = {folder / "functions.hpp"};
    const Compilation compilation = compile(options);
    EXPECT_EQ(closing_lines(compilation, "rddlc"), "");
    expect_golden(output, compilation.text, "generated");
}

INSTANTIATE_TEST_SUITE_P(, Generated, ::testing::ValuesIn(examples()),
                         [](const auto& example) { return example.param; });

TEST(GeneratedFolder, HoldsNothingElse) {
    std::set<std::string> expected;
    for (const std::string& name : examples()) expected.insert(name + ".cpp");
    for (const auto& entry : fs::directory_iterator(fs::path(RDDLC_SOURCE_FOLDER) / "generated")) {
        const std::string name = entry.path().filename().string();
        const bool is_simulator = entry.path().extension() == ".cpp";
        EXPECT_TRUE(!is_simulator || expected.contains(name)) << name;
    }
}

}  // namespace
}  // namespace rddlc::testing
