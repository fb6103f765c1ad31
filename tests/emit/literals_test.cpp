#include "emit/cpp/literals.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

namespace rddlc::cpp {
namespace {

std::string real(double value) {
    return literal(ir::Value{value});
}
std::string integer(std::int64_t value) {
    return literal(ir::Value{value});
}

TEST(Literal, ReadsWell) {
    EXPECT_EQ(real(0.1), "0.1");
    EXPECT_EQ(real(3.0), "3.0");
    EXPECT_EQ(real(-2.5), "-2.5");
    EXPECT_EQ(real(-0.0), "-0.0");
    EXPECT_EQ(real(1e300), "1e+300");
    EXPECT_EQ(integer(-7), "-7");
    EXPECT_EQ(literal(ir::Value{true}), "true");
}

TEST(Literal, SpellsWhatHasNoDigits) {
    EXPECT_EQ(real(HUGE_VAL), "std::numeric_limits<double>::infinity()");
    EXPECT_EQ(real(-HUGE_VAL), "-std::numeric_limits<double>::infinity()");
    EXPECT_EQ(real(std::nan("")), "std::numeric_limits<double>::quiet_NaN()");
    EXPECT_EQ(integer(std::numeric_limits<std::int64_t>::min()),
              "std::numeric_limits<std::int64_t>::min()");
    EXPECT_EQ(integer(std::numeric_limits<std::int64_t>::max()), "9223372036854775807");
}

TEST(Literal, ReadsBackBitForBit) {
    std::mt19937_64 bits(1);
    for (int i = 0; i < 100'000; ++i) {
        const double value = std::bit_cast<double>(bits());
        if (!std::isfinite(value)) continue;
        const std::string text = real(value);
        ASSERT_EQ(std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)),
                  std::bit_cast<std::uint64_t>(value))
            << text;
        ASSERT_NE(text.find_first_of(".e"), std::string::npos) << text << " is an int in C++";
    }
}

TEST(TableEntry, IsShort) {
    EXPECT_EQ(table_entry(ir::Value{true}), "1");
    EXPECT_EQ(table_entry(ir::Value{75.0}), "75");
    EXPECT_EQ(table_entry(ir::Value{0.5}), "0.5");
    EXPECT_EQ(table_entry(ir::Value{-0.0}), "-0.0") << "0 would lose the sign";
    EXPECT_EQ(table_entry(ir::Value{1e18}), "1e+18");
}

TEST(StringLiteral, EscapesWhatCppWouldRead) {
    EXPECT_EQ(literal(std::string_view("a\"b\\c")), "\"a\\\"b\\\\c\"");
    EXPECT_EQ(literal(std::string_view("\n1")), "\"\\0121\"");
    EXPECT_EQ(literal(std::string_view("é")), "\"é\"");
}

TEST(CommentText, CannotLeaveItsLine) {
    EXPECT_EQ(comment_text("a\nint x;"), "a int x;");
    EXPECT_EQ(comment_text("ends in \\"), "ends in")
        << "a continuation would swallow the next line";
}

}  // namespace
}  // namespace rddlc::cpp
