// Checks the pages of docs/diagnostics: the first example gets the page's diagnostic, the corrected
// one gets no diagnostic.
#include "parse/codes.hpp"
#include "parsed.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace rddlc {
namespace {

constexpr Code all_codes[] = {
    unexpected_token, missing_semicolon, unbalanced_bracket, reserved_word_as_name,
    missing_else,     illegal_character, not_utf8_text,      foreign_number,
    foreign_operator, foreign_comment,   misplaced_prime,    number_out_of_range,
    wrong_attribute,  empty_file,        nested_too_deeply,  expression_too_long,
    file_too_large,
};

std::string page_of(Code code) {
    const std::filesystem::path folder = RDDLC_SOURCE_DIR "/docs/diagnostics";
    std::ifstream stream(folder / (to_string(code) + ".md"));
    std::ostringstream text;
    text << stream.rdbuf();
    return std::move(text).str();
}

// The fenced blocks of RDDL.
std::vector<std::string> examples_in(std::string_view page) {
    constexpr std::string_view fence = "```rddl\n";
    std::vector<std::string> examples;
    for (std::size_t at = page.find(fence); at != page.npos; at = page.find(fence, at)) {
        at += fence.size();
        examples.emplace_back(page.substr(at, page.find("```", at) - at));
    }
    return examples;
}

class Page : public testing::TestWithParam<Code> {};

TEST_P(Page, HasATitle) {
    EXPECT_TRUE(page_of(GetParam()).starts_with("# " + to_string(GetParam()) + ": "));
}

TEST_P(Page, ShowsWhatTriggersTheCodeAndWhatDoesNot) {
    const std::vector<std::string> examples = examples_in(page_of(GetParam()));
    // Some errors cannot be shown on a page: bytes that are not text, and texts beyond the limits.
    if (examples.empty()) {
        const bool unprintable = GetParam() == not_utf8_text || GetParam() == nested_too_deeply ||
                                 GetParam() == expression_too_long || GetParam() == file_too_large;
        EXPECT_TRUE(unprintable);
        return;
    }
    ASSERT_GE(examples.size(), 2u);
    EXPECT_EQ(parse_text(examples[0]).codes(), to_string(GetParam())) << examples[0];
    EXPECT_EQ(parse_text(examples[1]).codes(), "") << examples[1];
}

INSTANTIATE_TEST_SUITE_P(Diagnostics, Page, testing::ValuesIn(all_codes),
                         [](const auto& page) { return to_string(page.param); });

}  // namespace
}  // namespace rddlc
