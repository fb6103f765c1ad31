#include "support/utf8.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <string>
#include <string_view>

namespace rddlc {
namespace {

TEST(Utf8, IsNotWhatOnlyLooksLikeIt) {
    EXPECT_TRUE(is_utf8(""));
    EXPECT_TRUE(is_utf8("a\xC3\xA9\xE2\x89\xA4\xF0\x9F\x98\x80"));
    for (const char* text : {"\xFF", "\xA9", "\xC3", "\xC3x", "\xE2\x89", "\xF0\x9F\x98"})
        EXPECT_FALSE(is_utf8(text)) << text;
    EXPECT_FALSE(is_utf8("\xC0\xAF")) << "'/' in two bytes";
    EXPECT_FALSE(is_utf8("\xE0\x80\xAF")) << "'/' in three bytes";
    EXPECT_FALSE(is_utf8("\xED\xA0\x80")) << "half of a surrogate pair";
    EXPECT_FALSE(is_utf8("\xF4\x90\x80\x80")) << "beyond the last code point";
}

TEST(Utf8, CharactersAreReadOneByOne) {
    EXPECT_EQ(first_character("\xC3\xA9x").bytes, "\xC3\xA9");
    EXPECT_EQ(first_character("\xE2\x89x").bytes, "\xE2") << "one byte of what is broken";
    EXPECT_TRUE(first_character("x").is_visible);
    for (const char* text :
         {"\x01", "\x7F", "\xC2\x9B", "\xE2\x80\xAE"})  // controls, right to left
        EXPECT_FALSE(first_character(text).is_visible);
}

TEST(Utf8, WhatIsPrintedDrivesNoTerminal) {
    EXPECT_EQ(printable("a\tb\n\xC3\xA9\xE6\xB0\xB4"), "a\tb\n\xC3\xA9\xE6\xB0\xB4");
    EXPECT_EQ(printable_line("a\tb\n"),
              "a\xEF\xBF\xBD"
              "b\xEF\xBF\xBD");
    for (const std::string text : {"\x1b", "\r", "\x7F", "\x9b", "\xff", "\xC2\x9B", "\xE2\x80\xAE",
                                   "\xE2\x80\xA8", "\xE2\x80\x8B"})
        EXPECT_EQ(printable("<" + text + ">"), "<\xEF\xBF\xBD>") << text;
    EXPECT_EQ(printable(std::string_view("\0", 1)), "\xEF\xBF\xBD");
}

// Widths on terminals: accents take no column, Chinese characters and emoji two.
TEST(Utf8, WidthsAreThoseOfTerminalsInAnyLocale) {
    for (const char* locale : {"C", "C.UTF-8"}) {
        std::setlocale(LC_ALL, locale);
        EXPECT_EQ(display_width("gr\xC3\xB6\xC3\x9F"
                                "e"),
                  5u);
        EXPECT_EQ(display_width("e\xCC\x81"), 1u);
        EXPECT_EQ(display_width("\xE6\xB0\xB4\xE4\xBD\x8D"), 4u);
        EXPECT_EQ(display_width("\xF0\x9F\x98\x80"), 2u);
        EXPECT_EQ(display_width("\xE2\x80\xA6"), 1u);
        EXPECT_EQ(display_width("\xFF\xFE"), 2u) << "each byte that is none is shown as one";
    }
    std::setlocale(LC_ALL, "C");
}

}  // namespace
}  // namespace rddlc
