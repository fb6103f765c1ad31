// Pairs of texts: golden/NAME.in.rddl and golden/NAME.out.rddl.
#include "golden.hpp"

#include "formatted.hpp"
#include "support/files.hpp"

#include <filesystem>

namespace rddlc {
namespace {

namespace fs = std::filesystem;

class FormatGolden : public ::testing::TestWithParam<const char*> {};

TEST_P(FormatGolden, IsAsExpected) {
    const fs::path folder = RDDLC_GOLDEN_DIR;
    const std::string name = GetParam();
    testing::expect_golden(folder / (name + ".out.rddl"),
                           expect_sound(read_file(folder / (name + ".in.rddl"))), "FormatGolden");
}

INSTANTIATE_TEST_SUITE_P(Format, FormatGolden,
                         ::testing::Values("comments", "everything", "expressions", "extensions",
                                           "tables"),
                         [](const auto& name) { return std::string(name.param); });

// The layout of the examples is the measure of this layout.
TEST(FormatExamples, AreLaidOutWell) {
    std::size_t files = 0;
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(RDDLC_SOURCE_DIR) / "examples")) {
        if (entry.path().extension() != ".rddl") continue;
        ++files;
        const std::string text = read_file(entry.path());
        EXPECT_EQ(testing::unified_diff(text, formatted(text)), "")
            << "rddl fmt " << entry.path().string();
    }
    EXPECT_GT(files, 0u);
}

}  // namespace
}  // namespace rddlc
