#include "support/writer.hpp"

#include <gtest/gtest.h>

namespace rddlc {
namespace {

TEST(Writer, IndentsLinesAndLeavesEmptyOnesEmpty) {
    Writer writer(2);
    writer.line("a").indent().line("b\n\nc").line().dedent().line("d").raw("e");
    EXPECT_EQ(writer.text(), "a\n  b\n\n  c\n\nd\ne");
}

TEST(Writer, WritesBlocks) {
    Writer writer;
    writer.block("f() {", "}", [&] { writer.line("g();"); });
    EXPECT_EQ(std::move(writer).text(), "f() {\n    g();\n}\n");
}

}  // namespace
}  // namespace rddlc
