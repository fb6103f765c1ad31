#include "lsp/outline.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <string_view>

namespace rddlc::lsp {
namespace {

const std::string problem = R"(// A grid.
domain grid {
    types { cell : object; colour : {@red, @blue}; };
    pvariables {
        // Neighbours.
        NEAR(cell, cell) : { non-fluent, bool, default = false };
        shade(cell) : { state-fluent, colour, default = @red };  // now
    };
    cpfs { shade'(?c) = if (exists_{?d : cell} NEAR(?c, ?d)) then @blue else shade(?c); };
    reward = 0;
}
instance one { domain = grid; objects { cell : {a, b}; }; non-fluents { NEAR(a, b); }; horizon = 3; discount = 1.0; }
)";

std::size_t count(const Outline& outline, Meaning meaning, std::string_view name) {
    std::size_t number = 0;
    for (const Occurrence& each : outline.occurrences)
        number += each.meaning == meaning && each.name.text == name ? 1 : 0;
    return number;
}

TEST(OutlineTest, HoldsWhatIsDeclared) {
    const Outline outline = outline_of(problem);
    ASSERT_EQ(outline.blocks.size(), 2u);
    EXPECT_EQ(outline.blocks[1].domain, "grid");
    ASSERT_EQ(outline.types.size(), 2u);
    EXPECT_EQ(outline.types[1].members->size(), 2u);
    ASSERT_EQ(outline.fluents.size(), 2u);
    EXPECT_EQ(outline.fluents[0].comment, "Neighbours.");
    EXPECT_EQ(outline.fluents[1].comment, "now");
    EXPECT_EQ(outline.fluents[1].kind.text, "state-fluent");
    EXPECT_EQ(outline.fluents[1].range.text, "colour");
    ASSERT_EQ(outline.lists.size(), 1u);
    EXPECT_EQ(outline.lists[0].objects[1].text, "b");
    EXPECT_EQ(count(outline, Meaning::Type, "cell"), 6u);
    EXPECT_EQ(count(outline, Meaning::Fluent, "shade"), 3u);
    EXPECT_EQ(count(outline, Meaning::Object, "a"), 2u);
}

TEST(OutlineTest, ABinderReachesAsFarAsTheGrammarSays) {
    const std::string text =
        "domain d { reward = (sum_{?x : t} f(?x) + 1) + if (g) then sum_{?y : t} f(?y) else f(?y); "
        "}";
    const Outline outline = outline_of(text);
    ASSERT_EQ(outline.bindings.size(), 2u);
    EXPECT_EQ(text.substr(outline.bindings[0].scope.end - 4, 4), " + 1");
    std::size_t unbound = 0;
    for (const Occurrence& each : outline.occurrences)
        unbound += each.meaning == Meaning::Variable && each.binding == outline.bindings.size();
    EXPECT_EQ(unbound, 1u);  // behind 'else'
}

TEST(OutlineTest, WhatFollowsAMistakeIsFound) {
    for (const char* const part :
         {"};\n    cpfs", "(cell) :", "{ state-fluent", "; };\n    reward", " };\n    cpfs"}) {
        std::string broken = problem;
        broken.erase(broken.find(part), 3);
        const Outline outline = outline_of(broken);
        EXPECT_EQ(outline.blocks.size(), 2u) << part;
        EXPECT_EQ(outline.fluents.size(), 2u) << part;
        EXPECT_EQ(outline.lists.size(), 1u) << part;
    }
}

TEST(OutlineTest, AnyBytesAreSurvived) {
    constexpr std::string_view bytes("{}()[];:_?@'\"\0\xFF =~", 18);
    std::mt19937 random(2);
    for (int round = 0; round < 3000; ++round) {
        std::string text = problem;
        const std::size_t begin = random() % text.size();
        text.erase(begin, random() % 40);
        for (int change = 0; change < 4; ++change)
            text[random() % text.size()] = bytes[random() % bytes.size()];
        const Outline outline = outline_of(text);
        for (const Occurrence& each : outline.occurrences) {
            ASSERT_LE(each.name.place.begin, each.name.place.end);
            ASSERT_LE(each.name.place.end, text.size());
        }
        for (const Block& block : outline.blocks) ASSERT_LE(block.whole.end, text.size());
    }
}

}  // namespace
}  // namespace rddlc::lsp
