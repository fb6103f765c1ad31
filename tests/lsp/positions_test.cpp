#include "lsp/positions.hpp"

#include <gtest/gtest.h>

namespace rddlc::lsp {
namespace {

Json at(int line, int character) {
    return {{"line", line}, {"character", character}};
}

TEST(PositionsTest, CountUtf16Units) {
    const Text text("a\xC3\xA9\xF0\x9F\x94\xA5z\r\nb\rc\n");  // a, e with accent, a fire, z
    EXPECT_EQ(text.position(0), at(0, 0));
    EXPECT_EQ(text.position(1), at(0, 1));
    EXPECT_EQ(text.position(3), at(0, 2));
    EXPECT_EQ(text.position(7), at(0, 4));
    EXPECT_EQ(text.position(10), at(1, 0));
    EXPECT_EQ(text.position(12), at(2, 0));
    EXPECT_EQ(text.position(14), at(3, 0));
    for (const std::uint32_t offset : {0u, 1u, 3u, 7u, 8u, 10u, 11u, 12u, 14u})
        EXPECT_EQ(text.offset(text.position(offset)), offset);
}

TEST(PositionsTest, BeyondTheTextIsItsEnd) {
    const Text text("ab\ncd");
    EXPECT_EQ(text.offset(at(0, 99)), 2u);
    EXPECT_EQ(text.offset(at(1, 99)), 5u);
    EXPECT_EQ(text.offset(at(99, 0)), 5u);
    EXPECT_EQ(Text("").offset(at(0, 3)), 0u);
    EXPECT_THROW(text.offset(Json{{"line", "a"}}), Json::exception);
}

TEST(PositionsTest, UrisArePaths) {
    EXPECT_EQ(path_of("file:///a%20b/c.rddl"), "/a b/c.rddl");
    EXPECT_EQ(path_of("file:///a/../b.rddl"), "/b.rddl");
    EXPECT_FALSE(path_of("untitled:Untitled-1"));
    EXPECT_FALSE(path_of("file://"));
    EXPECT_EQ(path_of("file:///100%"), "/100%");
    EXPECT_EQ(uri_of("/a b/\xC3\xA9.rddl"), "file:///a%20b/%C3%A9.rddl");
    EXPECT_EQ(path_of(uri_of("/x%y z")), "/x%y z");
}

}  // namespace
}  // namespace rddlc::lsp
