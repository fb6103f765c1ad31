#include "emit/names/identifiers.hpp"

#include <gtest/gtest.h>

namespace rddlc::cpp {
namespace {

TEST(Identifier, KeepsWhatCppCanSpell) {
    EXPECT_EQ(identifier("rlevel"), "rlevel");
    EXPECT_EQ(identifier("Max_LEVEL"), "Max_LEVEL");
    EXPECT_EQ(identifier("x2"), "x2");
}

TEST(Identifier, SpellsDashesAsUnderscores) {
    EXPECT_EQ(identifier("light-signal"), "light_signal");
    EXPECT_EQ(identifier("a--b"), "a_b") << "two underscores are reserved";
    EXPECT_EQ(identifier("a-_b"), "a_b");
}

TEST(Identifier, AvoidsReservedWords) {
    EXPECT_EQ(identifier("class"), "class_");
    EXPECT_EQ(identifier("co-await"), "co_await_");
    EXPECT_EQ(identifier("std"), "std_");
    EXPECT_EQ(identifier("rddl_problem"), "rddl_problem_");
    EXPECT_EQ(identifier("linux"), "linux_") << "a macro in GNU mode";
    EXPECT_EQ(identifier("module"), "module_") << "begins a directive at the start of a line";
}

TEST(Identifier, AvoidsWhatLooksLikeAMacro) {
    for (const char* name : {"NULL", "EOF", "I", "L", "M_PI", "SYS_open", "M_PIf", "NO_SUCH_MACRO"})
        EXPECT_EQ(identifier(name), std::string(name) + "_");
    EXPECT_EQ(identifier("errno"), "errno_");
}

TEST(Identifier, NeverBeginsWithADigitOrUnderscoreNorEndsWithOne) {
    EXPECT_EQ(identifier("2"), "x2");
    EXPECT_EQ(identifier("-"), "x");
    EXPECT_EQ(identifier("a-"), "a");
    EXPECT_EQ(identifier(""), "x");
}

TEST(Identifier, ExternalFunctionsAreCalledAsTheyAre) {
    EXPECT_EQ(external_identifier("settle-all"), "settle_all");
    EXPECT_EQ(external_identifier("LOSS"), "LOSS");
    EXPECT_EQ(external_identifier("new"), "new_");
}

TEST(Scope, MarksWhatIsTheUsers) {
    constexpr Mark table{"", "_"}, function{"set_", ""}, count{"", "_count"};
    Scope scope;
    EXPECT_EQ(scope.claim("LINK", table), "LINK_");
    EXPECT_EQ(scope.claim("class", table), "class_");
    EXPECT_EQ(scope.claim("link-", table), "link_");
    EXPECT_EQ(scope.claim("link", table), "link_2_") << "the mark stays at the end";
    EXPECT_EQ(scope.claim("reset", function), "set_reset");
    EXPECT_EQ(scope.claim("a--b", count), "a_b_count");
    EXPECT_EQ(scope.claim("a_b", count), "a_b_2_count");
}

TEST(Scope, NumbersWhatLooksLikeAMacro) {
    Scope scope;
    EXPECT_EQ(scope.claim("I"), "I_");
    EXPECT_EQ(scope.claim("I"), "I_2_");
}

TEST(Scope, NumbersNamesThatAreTaken) {
    Scope scope;
    EXPECT_EQ(scope.claim("a-b"), "a_b");
    EXPECT_EQ(scope.claim("a_b"), "a_b_2");
    EXPECT_EQ(scope.claim("a-b"), "a_b_3");
    EXPECT_EQ(scope.claim("int"), "int_");
    EXPECT_EQ(scope.claim("int"), "int_2");
}

TEST(Scope, DiffersFromTheScopeAround) {
    Scope outer(nullptr, {"state"});
    EXPECT_EQ(outer.claim("r"), "r");
    Scope inner(&outer);
    EXPECT_EQ(inner.claim("r"), "r_2");
    EXPECT_EQ(inner.claim("state"), "state_2");
}

TEST(Scope, FreesWhatIsReleased) {
    Scope scope;
    scope.claim("term");
    const std::size_t mark = scope.mark();
    EXPECT_EQ(scope.claim("term"), "term_2");
    EXPECT_EQ(scope.claim("r"), "r");
    scope.release(mark);
    EXPECT_EQ(scope.claim("r"), "r");
    EXPECT_EQ(scope.claim("term"), "term_2");
}

}  // namespace
}  // namespace rddlc::cpp
