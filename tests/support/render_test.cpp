#include "support/render.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rddlc {
namespace {

constexpr Code code{'E', 203};

std::string rendered(const Diagnostic& diagnostic, const Sources& sources,
                     const RenderOptions& options = {}) {
    Diagnostics diagnostics;
    diagnostics.report(diagnostic);
    return render(diagnostics, sources, options);
}

// The rendering of an error at a span of a file "f.rddl".
std::string at(const std::string& text, std::uint32_t begin, std::uint32_t end) {
    Sources sources;
    sources.add("f.rddl", text);
    return rendered({code, Span{0, begin, end}, "wrong"}, sources);
}

TEST(Render, ShowsTheLineWithCaretNoteAndHint) {
    Sources sources;
    sources.add("reservoir.rddl", "a : b;\n    x'(?r) = y(?r, ?s);\n");
    const Diagnostic diagnostic =
        Diagnostic{code, Span{0, 20, 29}, "'y' takes 1 argument (res), found 2"}
            .note({0, 0, 1}, "declared here")
            .note({0, 11, 13}, "in this definition")
            .with_hint("remove an argument");
    EXPECT_EQ(rendered(diagnostic, sources),
              "reservoir.rddl:2:14: error: 'y' takes 1 argument (res), found 2 [E0203]\n"
              "    2 |     x'(?r) = y(?r, ?s);\n"
              "      |              ^~~~~~~~~   declared at reservoir.rddl:1:1\n"
              "reservoir.rddl:2:5: note: in this definition\n"
              "hint: remove an argument\n");
}

TEST(Render, WritesNotesOfAnotherFormBelow) {
    Sources sources;
    sources.add("f.rddl", "abc\n");
    Diagnostic diagnostic{code, Span{0, 1, 2}, "wrong"};
    diagnostic.notes = {{std::nullopt, "no place"}, {Span{0, 0, 1}, "declared here"}};
    EXPECT_EQ(rendered(diagnostic, sources),
              "f.rddl:1:2: error: wrong [E0203]\n"
              "    1 | abc\n"
              "      |  ^\n"
              "note: no place\n"
              "f.rddl:1:1: note: declared here\n");
}

TEST(Render, WorksWithoutAPlace) {
    EXPECT_EQ(rendered({code, {}, "cannot open 'x.rddl'"}, {}),
              "error: cannot open 'x.rddl' [E0203]\n");
}

TEST(Render, CallsWarningsWarnings) {
    EXPECT_EQ(rendered({{'W', 210}, {}, "unused"}, {}), "warning: unused [W0210]\n");
}

TEST(Render, ExpandsTabs) {
    EXPECT_EQ(at("\ta\tb", 3, 4),
              "f.rddl:1:4: error: wrong [E0203]\n"
              "    1 |     a   b\n"
              "      |         ^\n");
}

TEST(Render, CountsUtf8AsOneColumnAndReplacesWhatIsNone) {
    EXPECT_EQ(at("\xC3\xA9\xFF\x01x", 4, 5),
              "f.rddl:1:4: error: wrong [E0203]\n"
              "    1 | \xC3\xA9\xEF\xBF\xBD\xEF\xBF\xBDx\n"
              "      |    ^\n");
}

TEST(Render, PutsTheCaretUnderWideCharactersAndBehindAccents) {
    const std::string water = "\xE6\xB0\xB4";  // takes two columns
    EXPECT_EQ(at(water + "e\xCC\x81" + water + "x", 6, 10),
              "f.rddl:1:4: error: wrong [E0203]\n"
              "    1 | " +
                  water + "e\xCC\x81" + water +
                  "x\n"
                  "      |    ^~~\n");
    EXPECT_EQ(at("\xCC\x81x", 2, 3),
              "f.rddl:1:2: error: wrong [E0203]\n"
              "    1 |  \xCC\x81x\n"
              "      |  ^\n")
        << "an accent on nothing";
}

TEST(Render, CutsNoWideCharacterInHalves) {
    std::string text = "a";
    for (int i = 0; i < 200; ++i) text += "\xE6\xB0\xB4";
    const std::string cut = at(text, 301, 304);
    EXPECT_NE(cut.find("| ... \xE6\xB0\xB4"), std::string::npos) << cut;
    EXPECT_NE(cut.find("\n      | " + std::string(58, ' ') + "^~\n"), std::string::npos) << cut;
}

TEST(Render, ReplacesWhatWouldSteerATerminal) {
    EXPECT_EQ(at("\xC2\x9B\xE2\x80\xAEx", 5, 6),
              "f.rddl:1:3: error: wrong [E0203]\n"
              "    1 | \xEF\xBF\xBD\xEF\xBF\xBDx\n"
              "      |   ^\n");
}

TEST(Render, MarksSpansOverSeveralLinesToTheEndOfTheFirst) {
    EXPECT_EQ(at("ab cd\r\nef\r\n", 3, 9),
              "f.rddl:1:4: error: wrong [E0203]\n"
              "    1 | ab cd\n"
              "      |    ^~\n");
}

TEST(Render, MarksTheEndOfAnEmptyFile) {
    EXPECT_EQ(at("", 0, 0),
              "f.rddl:1:1: error: wrong [E0203]\n"
              "    1 |\n"
              "      | ^\n");
}

TEST(Render, ShowsLongLinesAroundTheCaret) {
    const std::string text = at(std::string(5000, 'a') + "XY" + std::string(5000, 'b'), 5000, 5002);
    EXPECT_EQ(text,
              "f.rddl:1:5001: error: wrong [E0203]\n"
              "    1 | ..." +
                  std::string(55, 'a') + "XY" + std::string(53, 'b') +
                  "...\n"
                  "      | " +
                  std::string(58, ' ') + "^~\n");
}

TEST(Render, StaysInsideTheWindowForLongSpans) {
    const std::string text = at(std::string(100'000, 'a'), 10, 100'000);
    EXPECT_LT(text.size(), 400u);
    EXPECT_NE(text.find("aaa...\n"), std::string::npos);
}

TEST(Render, StopsAtTheErrorLimit) {
    Diagnostics diagnostics;
    for (int i = 0; i < 5; ++i) diagnostics.report({code, {}, "wrong"});
    EXPECT_EQ(render(diagnostics, {}, {.error_limit = 3}),
              "error: wrong [E0203]\nerror: wrong [E0203]\nerror: wrong [E0203]\n"
              "2 more errors not shown\n");
    EXPECT_EQ(render(diagnostics, {}, {.error_limit = 4}).substr(4 * 21),
              "1 more error not shown\n");
    EXPECT_EQ(render(diagnostics, {}, {.error_limit = 0}).size(), 5u * 21);
}

TEST(Render, ColorsOnlyWhenAsked) {
    EXPECT_EQ(rendered({code, {}, "wrong"}, {}).find('\x1b'), std::string::npos);
    const std::string colored = rendered({code, {}, "wrong"}, {}, {.color = true});
    EXPECT_NE(colored.find("\x1b[1;31merror:\x1b[0m"), std::string::npos);
}

TEST(Render, WritesJson) {
    Sources sources;
    sources.add("f.rddl", "a\n  bc\n");
    const Diagnostic diagnostic = Diagnostic{code, Span{0, 4, 6}, "wrong \"thing\""}
                                      .note({0, 0, 1}, "declared here")
                                      .with_hint("try");
    const auto json =
        nlohmann::json::parse(rendered(diagnostic, sources, {.format = DiagnosticsFormat::Json}));
    ASSERT_EQ(json.size(), 1u);
    EXPECT_EQ(json[0]["severity"], "error");
    EXPECT_EQ(json[0]["code"], "E0203");
    EXPECT_EQ(json[0]["message"], "wrong \"thing\"");
    EXPECT_EQ(json[0]["file"], "f.rddl");
    EXPECT_EQ(json[0]["line"], 2);
    EXPECT_EQ(json[0]["column"], 3);
    EXPECT_EQ(json[0]["end_column"], 5);
    EXPECT_EQ(json[0]["notes"][0]["line"], 1);
    EXPECT_EQ(json[0]["hint"], "try");
}

TEST(Render, WritesJsonOfBrokenTextAndOfNothing) {
    const std::string json =
        rendered({code, {}, "'\xFF'"}, {}, {.format = DiagnosticsFormat::Json});
    EXPECT_EQ(nlohmann::json::parse(json)[0]["message"], "'\xEF\xBF\xBD'");
    EXPECT_EQ(render(Diagnostics{}, {}, {.format = DiagnosticsFormat::Json}), "[]\n");
    EXPECT_EQ(render(Diagnostics{}, {}, {}), "");
}

}  // namespace
}  // namespace rddlc
