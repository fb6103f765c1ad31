#include "support/diagnostic.hpp"

#include <gtest/gtest.h>

namespace rddlc {
namespace {

constexpr Code error{'E', 203};
constexpr Code warning{'W', 210};

TEST(Code, IsReadAndWritten) {
    EXPECT_EQ(to_string(error), "E0203");
    EXPECT_EQ(parse_code("W0210"), warning);
    EXPECT_EQ(parse_code("e0203"), error) << "as people type it";
    for (const auto* bad : {"", "E", "E020", "E02033", "X0203", "E02a3"})
        EXPECT_FALSE(parse_code(bad)) << bad;
}

TEST(Diagnostics, CountErrorsOnly) {
    Diagnostics diagnostics;
    diagnostics.report({warning, {}, "careful"});
    EXPECT_FALSE(diagnostics.has_errors());
    diagnostics.report({error, {}, "wrong"});
    EXPECT_EQ(diagnostics.error_count(), 1u);
    EXPECT_EQ(diagnostics.all().size(), 2u);
}

TEST(Diagnostics, DropSilencedWarningsButNoErrors) {
    Diagnostics one({.disabled_warnings = {warning, error}, .codes_as_errors = {}});
    one.report({warning, {}, "careful"});
    one.report({error, {}, "wrong"});
    EXPECT_EQ(one.all().size(), 1u);

    Diagnostics all(
        {.disabled_warnings = {}, .all_warnings_disabled = true, .codes_as_errors = {}});
    all.report({warning, {}, "careful"});
    EXPECT_TRUE(all.all().empty());
}

TEST(Diagnostics, TurnWarningsIntoErrors) {
    Diagnostics all({.disabled_warnings = {}, .warnings_as_errors = true, .codes_as_errors = {}});
    all.report({warning, {}, "careful"});
    EXPECT_TRUE(all.has_errors());

    Diagnostics one({.disabled_warnings = {}, .codes_as_errors = {warning}});
    one.report({{'W', 211}, {}, "other"});
    EXPECT_FALSE(one.has_errors());
    one.report({warning, {}, "careful"});
    EXPECT_TRUE(one.has_errors());
}

TEST(Diagnostics, SortByPositionAndKeepTheOrderOtherwise) {
    Diagnostics diagnostics;
    diagnostics.report({error, Span{1, 0, 1}, "d"});
    diagnostics.report({error, Span{0, 5, 6}, "b"});
    diagnostics.report({error, Span{0, 5, 6}, "c"});
    diagnostics.report({error, {}, "a"});
    diagnostics.sort_by_position();
    std::string order;
    for (const Diagnostic& diagnostic : diagnostics.all()) order += diagnostic.message;
    EXPECT_EQ(order, "abcd");
}

TEST(DidYouMean, FindsMisspellings) {
    const std::vector<std::string> names = {"rlevel", "release", "rain"};
    EXPECT_EQ(did_you_mean("rlevle", names), "rlevel");
    EXPECT_EQ(did_you_mean("Release", names), "release");
    EXPECT_EQ(did_you_mean("ran", names), "rain");
    EXPECT_EQ(did_you_mean("overflow", names), std::nullopt);
    EXPECT_EQ(did_you_mean("x", {"y"}), std::nullopt);
    EXPECT_EQ(did_you_mean("", names), std::nullopt);
    EXPECT_EQ(did_you_mean("rain", {"rain"}), std::nullopt);
}

}  // namespace
}  // namespace rddlc
