#include "support/source.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace rddlc {
namespace {

// A file of this process alone: tests of several builds may run at once.
std::filesystem::path temporary_file() {
    return std::filesystem::temp_directory_path() /
           ("rddlc_source_test_" + std::to_string(getpid()));
}

TEST(Source, CountsLinesAndColumnsFromOne) {
    const Source source("f", "ab\ncd\n");
    EXPECT_EQ(source.position(0).line, 1);
    EXPECT_EQ(source.position(0).column, 1);
    EXPECT_EQ(source.position(4).line, 2);
    EXPECT_EQ(source.position(4).column, 2);
    EXPECT_EQ(source.position(6).line, 3);
    EXPECT_EQ(source.position(6).column, 1);
}

TEST(Source, CountsCodePointsNotBytes) {
    const Source source("f", "\xC3\xA9\xE2\x89\xA4x");
    EXPECT_EQ(source.position(5).column, 3);
}

TEST(Source, PutsOffsetsBehindTheEndAtTheEnd) {
    EXPECT_EQ(Source("f", "ab").position(99).column, 3);
    EXPECT_EQ(Source("f", "").position(0).line, 1);
}

TEST(Source, KnowsAllLineBreaks) {
    const Source source("f", "a\r\nb\rc\n");
    EXPECT_EQ(source.line(1), "a");
    EXPECT_EQ(source.line(2), "b");
    EXPECT_EQ(source.line(3), "c");
    EXPECT_EQ(source.line(4), "");
    EXPECT_EQ(source.position(3).line, 2);
    EXPECT_EQ(source.line_begin(3), 5u);
}

TEST(Sources, KeepsReferencesWhileGrowing) {
    Sources sources;
    const FileId first = sources.add("first", "text");
    const Source& reference = sources[first];
    for (int i = 0; i < 100; ++i) sources.add("more", "");
    EXPECT_EQ(reference.text(), "text");
    EXPECT_EQ(sources.text({first, 1, 3}), "ex");
    EXPECT_EQ(sources.location({first, 1, 3}), "first:1:2");
}

TEST(Sources, LoadsFilesAndSaysWhyNot) {
    const auto path = temporary_file();
    std::ofstream(path, std::ios::binary) << "a\r\nb";
    Sources sources;
    const auto loaded = sources.load(path);
    ASSERT_TRUE(loaded);
    EXPECT_EQ(sources[*loaded].text(), "a\r\nb");
    std::filesystem::remove(path);

    EXPECT_FALSE(sources.load(path));
    EXPECT_EQ(errno, ENOENT);
    EXPECT_FALSE(sources.load(std::filesystem::temp_directory_path()));
    EXPECT_EQ(errno, EISDIR);
}

TEST(Sources, LoadsAnEmptyFile) {
    const auto path = temporary_file();
    std::ofstream(path, std::ios::binary).flush();
    Sources sources;
    EXPECT_TRUE(sources.load(path));
    std::filesystem::remove(path);
}

TEST(Sources, PutsTextOnOneLineWithoutItsComments) {
    const auto on_one_line = [](const std::string& text) {
        Sources sources;
        const FileId file = sources.add("f", text);
        return sources.text_on_one_line({file, 0, static_cast<std::uint32_t>(text.size())});
    };
    EXPECT_EQ(on_one_line("a  // why\n   + b"), "a + b");
    EXPECT_EQ(on_one_line("a // to the end"), "a");
    EXPECT_EQ(on_one_line("\n a\n"), "a");
    EXPECT_EQ(on_one_line("a / b"), "a / b");
}

TEST(Span, CoversBoth) {
    EXPECT_EQ(cover({0, 3, 5}, {0, 7, 9}), (Span{0, 3, 9}));
    EXPECT_EQ(cover({0, 7, 9}, {0, 3, 5}), (Span{0, 3, 9}));
}

}  // namespace
}  // namespace rddlc
