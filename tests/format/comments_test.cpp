// To which words comments belong.
#include "format/comments.hpp"

#include <gtest/gtest.h>

namespace rddlc::format {
namespace {

using Texts = std::vector<std::string_view>;

TEST(Comments, BelongToTheWordBeforeThemOnTheSameLine) {
    const std::vector<Token> tokens = tokens_with_comments("a // first \n// second\nb\n");
    ASSERT_EQ(tokens.size(), 3u);
    EXPECT_EQ(tokens[0].behind, Texts{"// first"});
    ASSERT_EQ(tokens[1].above.size(), 1u);
    EXPECT_EQ(tokens[1].above[0].text, "// second");
    EXPECT_FALSE(tokens[1].above[0].blank_line_before);
    EXPECT_TRUE(tokens[1].begins_line());
}

TEST(Comments, GoOnBelowIfTheyBeginInTheSameColumn) {
    const std::vector<Token> tokens = tokens_with_comments("a; // one\n   // two\n  // three\nb");
    EXPECT_EQ(tokens[1].behind, (Texts{"// one", "// two"}));
    EXPECT_EQ(tokens[2].above[0].text, "// three");
}

TEST(Comments, AtTheEndBelongToTheEnd) {
    const std::vector<Token> tokens = tokens_with_comments("a\n\n// last");
    ASSERT_EQ(tokens.size(), 2u);
    EXPECT_EQ(tokens[1].text, "");
    EXPECT_TRUE(tokens[1].above[0].blank_line_before);
}

TEST(Comments, MayEndWithAnyLineBreak) {
    for (const char* text : {"// c\na", "// c\r\na", "// c\ra"}) {
        const std::vector<Token> tokens = tokens_with_comments(text);
        ASSERT_EQ(tokens.size(), 2u);
        EXPECT_EQ(tokens[0].above[0].text, "// c");
        EXPECT_EQ(tokens[0].line_breaks, 1u);
    }
}

TEST(Tokens, AreThoseOfTheLexer) {
    const char* const text = "p'(?x,@a-1)<=>~q-r_{1.5*.5-2}=>x==y~=z<=3 -4";
    const Texts expected{"p'", "(",  "?x",  ",",  "@a-1", ")",  "<=>", "~", "q-r",
                         "_",  "{",  "1.5", "*",  ".5",   "-",  "2",   "}", "=>",
                         "x",  "==", "y",   "~=", "z",    "<=", "3",   "-", "4"};
    const std::vector<Token> tokens = tokens_with_comments(text);
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(tokens[i].text, expected[i]) << i;
}

TEST(Tokens, BeginBehindAByteOrderMark) {
    EXPECT_EQ(tokens_with_comments("\xEF\xBB\xBF"
                                   "a")[0]
                  .text,
              "a");
}

}  // namespace
}  // namespace rddlc::format
