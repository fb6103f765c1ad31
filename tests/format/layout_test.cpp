// Rules of the layout, one by one.
#include "formatted.hpp"

namespace rddlc {
namespace {

TEST(FormatLayout, KeepsOneBlankLineBetweenDeclarations) {
    EXPECT_EQ(
        expect_sound("domain d {\n\n\n\ntypes {\n\na : object;\n\n\nb : object;\n\n};\n\n}\n"),
        "domain d {\n\n    types {\n\n        a : object;\n\n        b : object;\n    };\n}\n");
}

TEST(FormatLayout, SetsListsApart) {
    EXPECT_EQ(expect_sound("instance i { domain = d; init-state { p; }; horizon = 3; }"),
              "instance i {\n    domain = d;\n\n    init-state {\n        p;\n    };\n\n"
              "    horizon = 3;\n}\n");
}

TEST(FormatLayout, LeavesEmptyListsOnOneLine) {
    EXPECT_EQ(expect_sound("domain d { types { }; }"), "domain d {\n    types {};\n}\n");
    EXPECT_EQ(expect_sound("domain d { }"), "domain d {}\n");
}

TEST(FormatLayout, SetsBlocksApart) {
    EXPECT_EQ(expect_sound("domain d{}// end\ndomain e{}\n// here\ndomain f{};"),
              "domain d {}  // end\n\ndomain e {}\n\n// here\ndomain f {};\n");
}

TEST(FormatLayout, AlignsCommentsOfLinesThatFollowEachOther) {
    EXPECT_EQ(
        expect_sound("domain d { types { a : object;// 1\nbb : {@x};//2\n\nc : object; // 3\n}; }"),
        "domain d {\n    types {\n        a  : object;  // 1\n        bb : {@x};    //2\n\n"
        "        c : object;  // 3\n    };\n}\n");
}

TEST(FormatLayout, DoesNotAlignWhatIsOfVeryDifferentWidth) {
    const std::string name(60, 'n');
    EXPECT_EQ(expect_sound("domain d { cpfs { a = 1;\n" + name + " = 2; }; }"),
              "domain d {\n    cpfs {\n        a = 1;\n        " + name + " = 2;\n    };\n}\n");
}

TEST(FormatLayout, WritesLinesOfUnix) {
    EXPECT_EQ(expect_sound("\xEF\xBB\xBF// c  \r\ndomain d { }\r\n"), "// c\ndomain d {}\n");
}

TEST(FormatLayout, KeepsBracketsAndSpellings) {
    EXPECT_EQ(expect_sound("domain d { cdfs { p() = ([a & 007.50]) ; }; }"),
              "domain d {\n    cdfs {\n        p() = ([a & 007.50]);\n    };\n}\n");
}

}  // namespace
}  // namespace rddlc
