// Checks the pages of docs/diagnostics: the first example gets the page's diagnostic and no other,
// the corrected one gets no diagnostic.
#include "ground/codes.hpp"
#include "problem.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace rddlc {
namespace {

std::string page_of(Code code) {
    std::ifstream stream(std::filesystem::path(PAGES_FOLDER) / (to_string(code) + ".md"));
    std::ostringstream text;
    text << stream.rdbuf();
    return std::move(text).str();
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

class PageTest : public testing::TestWithParam<Code> {};

TEST_P(PageTest, ShowsWhatTriggersTheCodeAndWhatDoesNot) {
    const std::string code = to_string(GetParam());
    const std::string page = page_of(GetParam());
    EXPECT_TRUE(page.starts_with("# " + code + ": ")) << page;
    const std::vector<std::string> examples = examples_in(page);
    ASSERT_EQ(examples.size(), 2u);
    const Grounded refused = ground_text(examples[0]);
    EXPECT_EQ(refused.program.has_value(), GetParam().letter == 'W');
    EXPECT_EQ(refused.codes, code) << refused.messages;
    const Grounded accepted = ground_text(examples[1]);
    EXPECT_TRUE(accepted.program);
    EXPECT_EQ(accepted.codes, "") << accepted.messages;
}

INSTANTIATE_TEST_SUITE_P(Diagnostics, PageTest,
                         testing::Values(grounding::not_supported_yet,
                                         grounding::contradictory_bounds,
                                         grounding::too_many_groundings, grounding::certain_fault),
                         [](const auto& code) { return to_string(code.param); });

}  // namespace
}  // namespace rddlc
