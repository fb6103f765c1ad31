// Tables, numbers and hashes.
#include "formats/number_text.hpp"
#include "formats/table.hpp"
#include "support/sha256.hpp"
#include "terminal/progress.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rddlc::workbench {
namespace {

TEST(Progress, EstimatesNothingAtTheBeginning) {
    EXPECT_EQ(remaining_text(0, 5), "");
    EXPECT_EQ(remaining_text(3e-7, 0.1), "") << "94 h, by nothing but the start";
    EXPECT_EQ(remaining_text(0.001, 1), "16 min 39 s left");
    EXPECT_EQ(remaining_text(0.05, 0.1), "1.9 s left");
}

TEST(TextTable, AlignsColumns) {
    TextTable table({{"name"}, {"count", Align::Right}, {"note"}});
    table.add_row({"a", "1", ""});
    table.add_row({"größe", "1,000", "x"});
    table.add_row({"b"});
    EXPECT_EQ(table.text(1),
              " name   count  note\n"
              " a          1\n"
              " größe  1,000  x\n"
              " b\n");
}

TEST(TextTable, AlignsWideCharacters) {
    TextTable table({{"name"}, {"note"}});
    table.add_row({"水位計", "x"});
    EXPECT_EQ(table.text(), "name    note\n水位計  x\n");
}

TEST(TextTable, OmitsEmptyTitles) {
    TextTable table({{""}, {""}});
    table.add_row({"a", "b"});
    EXPECT_EQ(table.text(), "a  b\n");
}

TEST(Text, IsShortenedAndWrappedByWidth) {
    EXPECT_EQ(shortened("größe", 5), "größe");
    EXPECT_EQ(shortened("größer", 5), "größ…");
    EXPECT_EQ(shortened("水位計", 5), "水位…");
    EXPECT_EQ(shortened("水位計", 4), "水…");
    EXPECT_EQ(wrapped("one two three", 7), (std::vector<std::string>{"one two", "three"}));
    EXPECT_EQ(wrapped("unbreakable", 3), (std::vector<std::string>{"unbreakable"}));
}

TEST(Text, GroupsDigits) {
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(999), "999");
    EXPECT_EQ(grouped(1000), "1,000");
    EXPECT_EQ(grouped(-1234567), "-1,234,567");
}

TEST(Text, ShowsRatesAndDurations) {
    EXPECT_EQ(rate_text(812), "812");
    EXPECT_EQ(rate_text(5.126e6), "5.13 M");
    EXPECT_EQ(rate_text(999950), "1 M");
    EXPECT_EQ(seconds_text(999.9e-6), "1 ms");
    EXPECT_EQ(seconds_text(0.0021), "2.1 ms");
    EXPECT_EQ(duration_text(200), "3 min 20 s");
}

// FIPS 180-4 examples.
TEST(Sha256, KnownAnswers) {
    EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(sha256(std::string(1000000, 'a')),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

}  // namespace
}  // namespace rddlc::workbench
