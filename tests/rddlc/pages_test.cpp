// Every diagnostic has a page in docs/diagnostics, and every page a diagnostic.
#include "driver/explain.hpp"
#include "run_rddlc.hpp"

#include <fstream>
#include <map>
#include <regex>
#include <set>

namespace rddlc::testing {
namespace {

namespace fs = std::filesystem;

// The codes that the stages define in their codes.hpp.
std::set<std::string> defined_codes() {
    static const std::regex form(R"(Code (\w+)\{'([EW])', (\d+)\})");
    std::set<std::string> codes;
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(RDDLC_SOURCE_FOLDER) / "compiler")) {
        if (entry.path().filename() != "codes.hpp") continue;
        std::ifstream stream(entry.path());
        const std::string text(std::istreambuf_iterator<char>(stream), {});
        const auto end = std::sregex_iterator();
        for (auto it = std::sregex_iterator(text.begin(), text.end(), form); it != end; ++it) {
            const std::string name = to_string(Code{(*it)[2].str()[0], std::stoi((*it)[3])});
            EXPECT_TRUE(codes.insert(name).second) << name << " is defined twice";
        }
    }
    return codes;
}

TEST(Pages, ExplainExactlyTheCodesThatThereAre) {
    std::set<std::string> explained;
    for (const Page& page : pages) explained.insert(std::string(page.name));
    const std::set<std::string> defined = defined_codes();
    EXPECT_GT(defined.size(), 20u);
    for (const std::string& code : defined) EXPECT_TRUE(explained.contains(code)) << code;
    for (const std::string& code : explained) EXPECT_TRUE(defined.contains(code)) << code;
}

TEST(Pages, BeginWithTheirCode) {
    for (const Page& page : pages) {
        EXPECT_TRUE(page.text.starts_with("# " + std::string(page.name) + ": ")) << page.name;
    }
}

TEST(Pages, OfWarningsTellHowToSilenceThem) {
    for (const Page& page : pages) {
        if (page.name[0] != 'W') continue;
        EXPECT_NE(page.text.find("-Wno-" + std::string(page.name)), std::string_view::npos)
            << page.name;
    }
}

using Explain = RddlcTest;

TEST_F(Explain, PrintsThePage) {
    const Result result = rddlc({"--explain", "E0901"});
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.output, *explain(Code{'E', 901}));
}

}  // namespace
}  // namespace rddlc::testing
