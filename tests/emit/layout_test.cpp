#include "emit/layout.hpp"

#include <gtest/gtest.h>

namespace rddlc::cpp {
namespace {

using Lines = std::vector<std::string>;

std::string repeated(const std::string& text, int times) {
    std::string result;
    for (int i = 0; i < times; ++i) result += text;
    return result;
}

TEST(Fill, PutsAsMuchIntoALineAsFits) {
    const std::string word(30, 'w');
    EXPECT_EQ(fill({word, word, word, word}, 0, 0), (Lines{word + " " + word + " " + word, word}));
    EXPECT_EQ(fill({word, word, word}, 10, 0), (Lines{word + " " + word, word}));
    EXPECT_EQ(fill({word, word, word}, 0, 9), (Lines{word + " " + word, word}))
        << "room for what follows";
}

TEST(FillChain, AlignsUnderTheFirstOperand) {
    const std::string operand(25, 'a');
    const std::string chain = operand + repeated(" + " + operand, 3) + ";";
    EXPECT_EQ(fill_chain("return ", chain, {"+", "-"}, 8),
              (Lines{"return " + operand + " + " + operand + " + " + operand + " +",
                     "       " + operand + ";"}));
}

TEST(FillChain, BreaksBehindTheEqualSignIfThatSavesLines) {
    const std::string chain = std::string(40, 'a') + " + " + std::string(40, 'b') + ";";
    EXPECT_EQ(fill_chain("next.x = ", chain, {"+"}, 8), (Lines{"next.x =", "    " + chain}));
}

TEST(FillChain, BreaksOutsideOfBracketsOnly) {
    const std::string operand = "f(" + std::string(20, 'a') + " + " + std::string(20, 'b') + ")";
    EXPECT_EQ(fill_chain("return ", operand + " + " + operand + ";", {"+"}, 8),
              (Lines{"return " + operand + " +", "       " + operand + ";"}));
}

TEST(FillCall, AlignsArgumentsUnderTheFirst) {
    const std::string a(60, 'a'), b(30, 'b');
    EXPECT_EQ(fill_call("return f(" + a + ", {" + b + ", c});", 7, 4),
              (Lines{"return f(" + a + ",", "         {" + b + ", c});"}));
}

TEST(FillCall, BreaksBehindTheBracketIfThereIsNoRoom) {
    const std::string head = "const Real x = " + std::string(40, 'f') + "(";
    const std::string a(50, 'a');
    EXPECT_EQ(fill_call(head + a + ", b);", 15, 4), (Lines{head, "    " + a + ", b);"}));
}

TEST(FillCall, PutsParametersUnderEachOther) {
    EXPECT_EQ(fill_call("static void f(", {"a", "b"}, ") {", 4), (Lines{"static void f(a, b) {"}));
    EXPECT_EQ(fill_call("static void f(", {std::string(76, 'a'), "bbbbbbb"}, ") {", 4),
              (Lines{"static void f(" + std::string(76, 'a') + ",", "              bbbbbbb) {"}));
    EXPECT_EQ(fill_call("f(", {}, ");", 4), (Lines{"f();"}));
}

}  // namespace
}  // namespace rddlc::cpp
