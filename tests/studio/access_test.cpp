// Which senders the page's server answers.
#include "studio/access.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace rddlc::studio {
namespace {

const Access access(7334, "secret");

TEST(AccessTest, OwnPageIsAnswered) {
    for (const char* const name : {"127.0.0.1:7334", "localhost:7334"}) {
        const std::string origin = std::string("http://") + name;
        EXPECT_FALSE(access.refusal_of_page({name, "", ""}));
        EXPECT_FALSE(access.refusal_of_request({name, origin, "secret"}));
        EXPECT_FALSE(access.refusal_of_request({name, "", "secret"}));  // a program
    }
}

TEST(AccessTest, OtherPagesAreRefused) {
    const std::string_view host = "127.0.0.1:7334";
    for (const char* const origin :
         {"http://evil.example", "null", "https://127.0.0.1:7334", "http://127.0.0.1:7335",
          "http://127.0.0.1", "http://127.0.0.1:73340", "http://127.0.0.1:7334.evil.example"}) {
        EXPECT_TRUE(access.refusal_of_page({host, origin, ""})) << origin;
        EXPECT_TRUE(access.refusal_of_request({host, origin, "secret"})) << origin;
    }
}

TEST(AccessTest, OtherNamesOfTheMachineAreRefused) {
    for (const char* const host : {"", "evil.example", "evil.example:7334", "127.0.0.1",
                                   "localhost", "127.0.0.1:80", "127.0.0.1.evil.example:7334"}) {
        EXPECT_TRUE(access.refusal_of_page({host, "", ""})) << host;
        EXPECT_TRUE(access.refusal_of_request({host, "", "secret"})) << host;
    }
}

TEST(AccessTest, RequestsNeedTheToken) {
    for (const char* const token : {"", "secre", "secret ", "Secret", "secretsecret"})
        EXPECT_TRUE(access.refusal_of_request({"127.0.0.1:7334", "", token})) << token;
    EXPECT_EQ(access.address(), "http://127.0.0.1:7334/#secret");
}

TEST(AccessTest, TokensAreLongAndDiffer) {
    std::set<std::string> tokens;
    for (int i = 0; i < 100; ++i) tokens.insert(new_token());
    EXPECT_EQ(tokens.size(), 100u);
    for (const std::string& token : tokens) {
        EXPECT_EQ(token.size(), 64u);
        EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), token.npos);
    }
}

}  // namespace
}  // namespace rddlc::studio
