#include "emit/identifiers.hpp"

#include <gtest/gtest.h>

namespace rddlc::cpp {
namespace {

TEST(Identifier, KeepsWhatCppCanSpell) {
    EXPECT_EQ(identifier("rlevel"), "rlevel");
    EXPECT_EQ(identifier("MAX_LEVEL"), "MAX_LEVEL");
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
    EXPECT_EQ(identifier("NULL"), "NULL_");
    EXPECT_EQ(identifier("std"), "std_");
    EXPECT_EQ(identifier("L"), "L_");
    EXPECT_EQ(identifier("linux"), "linux_") << "a macro in GNU mode";
}

TEST(Identifier, NeverBeginsWithADigitOrUnderscore) {
    EXPECT_EQ(identifier("2"), "x2");
    EXPECT_EQ(identifier("-"), "x_");
    EXPECT_EQ(identifier(""), "x");
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
