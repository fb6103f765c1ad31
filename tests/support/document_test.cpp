// The algebra of documents.
#include "support/document.hpp"

#include <gtest/gtest.h>

namespace rddlc::document {
namespace {

std::string rendered(const Doc& doc, std::string head = "") {
    std::vector<TextLine> lines;
    render(doc, std::move(head), 0, lines);
    std::string result;
    for (const TextLine& line : lines)
        result += line.text + (line.comment.empty() ? "" : " " + line.comment) + "\n";
    return result;
}

Doc word(std::size_t length) {
    return text(std::string(length, 'x'));
}

TEST(Document, GroupsAreOnOneLineIfTheyFit) {
    EXPECT_EQ(rendered(group(concat({text("a"), line(), text("b")}))), "a b\n");
    EXPECT_EQ(rendered(group(concat({text("a"), line(), text("b")}), true)), "a\nb\n");
    EXPECT_EQ(rendered(group(concat({word(98), line(), text("b")}))).size(), 101u);
    EXPECT_EQ(rendered(group(concat({word(99), line(), text("b")}))),
              std::string(99, 'x') + "\nb\n");
}

TEST(Document, WhatFollowsAGroupCountsUpToTheNextLine) {
    const Doc inner = group(concat({word(96), line(), text("b")}));
    EXPECT_EQ(rendered(concat({inner, text("; ")})), std::string(96, 'x') + " b;\n");
    EXPECT_EQ(rendered(concat({inner, text(";;;")})), std::string(96, 'x') + "\nb;;;\n");
    EXPECT_EQ(rendered(concat({inner, line(), word(9)})), std::string(96, 'x') + " b\nxxxxxxxxx\n");
}

TEST(Document, LinesAreNestedAndAligned) {
    const Doc lines = concat({text("a"), line(), text("b")});
    EXPECT_EQ(rendered(nest(lines)), "a\n    b\n");
    EXPECT_EQ(rendered(concat({text("x = "), align(lines)})), "x = a\n    b\n");
    EXPECT_EQ(rendered(concat({word(80), nest(align(lines))})),
              std::string(80, 'x') + "a\n        b\n");
}

TEST(Document, TheFirstAlternativeThatFitsIsTaken) {
    const Doc wide = word(101), narrow = text("a"), last = text("b");
    EXPECT_EQ(rendered(alternatives({wide, narrow, last})), "a\n");
    EXPECT_EQ(rendered(alternatives({wide, wide, last})), "b\n");
}

TEST(Document, CommentsEndTheirLine) {
    const Doc behind = concat({text("a"), trailing_comment({"// c"})});
    EXPECT_EQ(rendered(group(concat({behind, line(), text("b")}))), "a // c\nb\n");
    EXPECT_EQ(rendered(concat({behind, text(" "), text("b")})), "a // c\nb\n");
    EXPECT_EQ(rendered(group(concat({text("x"), line(), behind}))), "x a // c\n");
    EXPECT_EQ(rendered(concat({text("a "), own_line_comment("// c"), text("b")})), "a\n// c\nb\n");
}

TEST(Document, BlanksAreNotLeftAtTheEndOfLines) {
    EXPECT_EQ(rendered(concat({text("a "), line(), text("b")})), "a\nb\n");
}

TEST(Document, FlatWidthIsThatOfOneLine) {
    EXPECT_EQ(flat_width(concat({text("ab"), line(), if_broken("xyz"), text("c")})), 4u);
    EXPECT_EQ(flat_width(group(text("a"), true)), unbounded);
    EXPECT_EQ(flat_width(trailing_comment({"// c"})), unbounded);
}

}  // namespace
}  // namespace rddlc::document
