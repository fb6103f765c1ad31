// Completion in texts that are cut off anywhere, and at every place of one.
#include "lsp/capabilities.hpp"

#include <gtest/gtest.h>

#include <string>

namespace rddlc::lsp {
namespace {

const std::string whole_problem = R"(domain d {
    types { place : object; colour : { @red, @green }; };
    pvariables {
        COST(place) : { non-fluent, real, default = 1.5 };
        at(place) : { state-fluent, bool, default = false };
        shade : { state-fluent, colour, default = @red };
        go(place) : { action-fluent, bool, default = false };
    };
    cpfs {
        at'(?p) = if (go(?p)) then true else at(?p) ^ exists_{?q : place} [go(?q)];
        shade' = @green;
    };
    reward = -(sum_{?p : place} [COST(?p) * go(?p)]);
}
non-fluents n { domain = d; objects { place : {a, b}; }; non-fluents { COST(a) = 2; }; }
instance i { domain = d; non-fluents = n; init-state { at(a); }; horizon = 5; discount = 1; }
)";

// Throws and crashes nowhere; returns how many places have completions.
std::size_t places_with_completions(const std::string& content, std::size_t first) {
    Workspace workspace;
    workspace.open("studio:/d.rddl", 1, content);
    const FilePtr file = workspace.find("studio:/d.rddl");
    const Lookup lookup(file, workspace.family_of(file));
    std::size_t places = 0;
    for (std::size_t at = first; at <= content.size(); ++at)
        places +=
            completion(lookup, static_cast<std::uint32_t>(at), Standard::PyRddlGym)["items"].empty()
                ? 0
                : 1;
    return places;
}

TEST(CompletionTest, EveryPlaceOfAText) {
    EXPECT_GT(places_with_completions(whole_problem, 0), whole_problem.size() / 3);
}

TEST(CompletionTest, EndOfEveryPrefix) {
    for (std::size_t length = 0; length <= whole_problem.size(); ++length)
        places_with_completions(whole_problem.substr(0, length), length);
}

TEST(CompletionTest, SectionWithoutItsBracket) {
    for (const char* const beginning :
         {"domain d { cpfs", "domain d { cpfs ", "domain d { pvariables x",
          "instance i { init-state = ", "instance i { init-state { = ", "domain d { cpfs ) ) x = "})
        places_with_completions(beginning, 0);
}

}  // namespace
}  // namespace rddlc::lsp
