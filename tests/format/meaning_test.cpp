// Comments and line breaks in all places.
#include "formatted.hpp"
#include "support/files.hpp"

#include <filesystem>
#include <random>

namespace rddlc {
namespace {

namespace fs = std::filesystem;

// A file with all that the grammar has.
std::string everything() {
    return read_file(fs::path(RDDLC_GOLDEN_DIR) / "everything.in.rddl");
}

// The words of a text with something between each two.
template <class Between>
std::string joined(const std::string& text, Between between) {
    std::string result;
    std::size_t number = 0;
    for (const std::string& word : words(text)) result += word + between(number++);
    return result;
}

TEST(Meaning, SurvivesACommentBehindEachWord) {
    const auto all = words(everything());
    for (std::size_t place = 0; place + 1 < all.size(); ++place) {
        expect_sound(
            joined(everything(), [&](std::size_t n) { return n == place ? " // here\n" : " "; }));
        if (HasFailure()) return;
    }
}

TEST(Meaning, SurvivesACommentAboveEachWord) {
    const auto all = words(everything());
    for (std::size_t place = 0; place < all.size(); ++place) {
        expect_sound(joined(everything(),
                            [&](std::size_t n) { return n == place ? "\n\n// a\n// b\n" : "\n"; }));
        if (HasFailure()) return;
    }
}

TEST(Meaning, SurvivesCommentsEverywhere) {
    expect_sound(joined(everything(), [](std::size_t n) {
        return " // behind " + std::to_string(n) + "\n // above " + std::to_string(n) + "\n";
    }));
}

TEST(Meaning, SurvivesRandomLayouts) {
    std::mt19937 random(7);
    const std::string layouts[] = {" ",  " ",    " ",      " ",         "\n",
                                   "\t", "\n\n", "\n    ", " // c\r\n", "\n\n\n  // c\n\n"};
    for (int round = 0; round < 200; ++round) {
        // From nearly all blanks to all of it.
        const std::size_t choices = 4 + random() % (std::size(layouts) - 3);
        expect_sound(
            joined(everything(), [&](std::size_t) { return layouts[random() % choices]; }));
        if (HasFailure()) return;
    }
}

TEST(Meaning, OfExamplesAndCasesIsKept) {
    std::size_t files = 0;
    for (const char* folder : {"examples", "tests/cases"}) {
        for (const auto& entry :
             fs::recursive_directory_iterator(fs::path(RDDLC_SOURCE_DIR) / folder)) {
            if (entry.path().extension() != ".rddl") continue;
            const std::string text = read_file(entry.path());
            Sources sources;
            Diagnostics diagnostics;
            const FileId file = sources.add(entry.path().string(), text);
            if (!format_file(sources, file, diagnostics)) continue;  // a case of a syntax error
            SCOPED_TRACE(entry.path().string());
            expect_sound(text);
            ++files;
        }
    }
    EXPECT_GT(files, 20u);
}

TEST(Meaning, OfDeepExpressionsIsKept) {
    std::string sum = "1", nested = "1";
    for (int i = 0; i < 900; ++i) sum += " + p" + std::to_string(i);
    for (int i = 0; i < 240; ++i) nested = "(" + nested + " + 2)";
    expect_sound("domain d { reward = " + sum + "; termination { " + nested + " > 3; }; }");
}

TEST(Meaning, OfTextsThatAreNotRddlIsReported) {
    for (const char* text : {"", "// nothing\n", "domain d { reward = ; }", "domain d {"}) {
        Sources sources;
        Diagnostics diagnostics;
        const FileId file = sources.add("test.rddl", text);
        EXPECT_FALSE(format_file(sources, file, diagnostics)) << text;
        EXPECT_TRUE(diagnostics.has_errors()) << text;
    }
}

}  // namespace
}  // namespace rddlc
