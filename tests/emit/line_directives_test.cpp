#include "emit/cpp/line_directives.hpp"

#include <gtest/gtest.h>

namespace rddlc::cpp {
namespace {

TEST(LineDirectives, NameThePlaceInTheSource) {
    Sources sources;
    const FileId file = sources.add("a \"b\".rddl", "one\ntwo\n");
    EXPECT_EQ(line_directive(sources, {file, 4, 7}), "#line 2 \"a \\\"b\\\".rddl\"");
}

TEST(LineDirectives, GoBackToTheLineThatFollows) {
    EXPECT_EQ(restore_lines("1\n#line here\n3\n#line here\n5\n", "sim.cpp"),
              "1\n#line 3 \"sim.cpp\"\n3\n#line 5 \"sim.cpp\"\n5\n");
}

}  // namespace
}  // namespace rddlc::cpp
