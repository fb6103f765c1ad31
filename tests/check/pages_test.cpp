// Checks the pages of docs/diagnostics: the first example gets the page's diagnostic and no other,
// the corrected one gets no diagnostic.
#include "checking.hpp"
#include "support/files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

namespace rddlc::testing {
namespace {

const std::filesystem::path pages = PAGES_FOLDER;

// The codes of this stage: the hundreds 02 to 05.
std::vector<std::string> codes_with_pages() {
    std::vector<std::string> codes;
    for (const auto& entry : std::filesystem::directory_iterator(pages)) {
        const std::string name = entry.path().stem();
        const auto code = parse_code(name);
        if (code && code->number >= 200 && code->number < 600) codes.push_back(name);
    }
    std::ranges::sort(codes);
    return codes;
}

// Every constant in check/codes.hpp: "...{'E', 203};".
std::vector<std::string> codes_in_header() {
    std::istringstream header(read_file(CODES_HEADER));
    std::vector<std::string> codes;
    for (std::string line; std::getline(header, line);) {
        const std::size_t letter = line.find("{'");
        if (letter == std::string::npos) continue;
        codes.push_back(to_string(Code{line[letter + 2], std::stoi(line.substr(letter + 6))}));
    }
    std::ranges::sort(codes);
    return codes;
}

std::vector<std::string> examples_in(const std::string& page) {
    constexpr std::string_view fence = "```rddl\n";
    std::vector<std::string> examples;
    for (std::size_t at = page.find(fence); at != page.npos; at = page.find(fence, at)) {
        at += fence.size();
        examples.push_back(page.substr(at, page.find("```", at) - at));
    }
    return examples;
}

TEST(DiagnosticPages, ThereIsOneForEachCode) {
    EXPECT_EQ(codes_with_pages(), codes_in_header());
}

class PageTest : public ::testing::TestWithParam<std::string> {};

TEST_P(PageTest, ShowsWhatTriggersTheCodeAndWhatDoesNot) {
    const std::string& code = GetParam();
    const std::string page = read_file(pages / (code + ".md"));
    EXPECT_TRUE(page.starts_with("# " + code + ": ")) << page;
    if (code.starts_with('W')) {
        EXPECT_NE(page.find("-Wno-" + code), std::string::npos);
    }
    if (code == "E0230") return;  // takes an instance too large for a page: see values_test.cpp
    const std::vector<std::string> examples = examples_in(page);
    ASSERT_EQ(examples.size(), 2u);
    EXPECT_EQ(check_text(examples[0]).codes(), code) << check_text(examples[0]).rendered();
    EXPECT_EQ(check_text(examples[1]).codes(), "") << check_text(examples[1]).rendered();
}

INSTANTIATE_TEST_SUITE_P(Diagnostics, PageTest, ::testing::ValuesIn(codes_with_pages()),
                         [](const auto& page) { return page.param; });

}  // namespace
}  // namespace rddlc::testing
