// JSON of users: what is refused, and how, and what is written.
#include "support/json_text.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace rddlc {
namespace {

// Both readers refuse it, and throw nothing else.
std::string refusal(const std::string& text) {
    std::string message = "accepted";
    for (const bool ordered : {false, true}) {
        try {
            if (ordered)
                parse_ordered_json(text);
            else
                parse_json(text);
        } catch (const RefusedJson& refused) {
            if (ordered) {
                EXPECT_EQ(message, refused.what());
            }
            message = refused.what();
        }
    }
    return message;
}

TEST(JsonText, RefusesWhatOthersMayTakeInOneWay) {
    EXPECT_NE(refusal("[1e400]").find("1e400"), std::string::npos);
    EXPECT_NE(refusal(R"({"a": -1e999999999999999999999})").find("number overflow"),
              std::string::npos);
    EXPECT_EQ(refusal(R"({"a": 1, "b": {"a": 1}, "a": 2})"), "the member 'a' is given twice");
    EXPECT_EQ(refusal(std::string(100'000, '[')), "more than 256 brackets lie within each other");
    EXPECT_EQ(refusal(std::string(256, '[') + std::string(256, ']')), "accepted");
    for (const char* text : {"", "{", "[1,]", "nan", "[NaN]", "'a'", R"(["\ud800"])",
                             R"(["\udc00x"])", "[\"\xff\"]", "[\"\x1b\"]", "1 2"})
        EXPECT_NE(refusal(text).find("parse error"), std::string::npos) << text;
}

TEST(JsonText, TellsWhereJsonEnds) {
    try {
        parse_json("[1, x]");
        FAIL();
    } catch (const RefusedJson& refused) {
        EXPECT_EQ(refused.byte, std::optional<std::size_t>(4));
    }
    try {
        parse_json("[1e400]");
        FAIL();
    } catch (const RefusedJson& refused) {
        EXPECT_FALSE(refused.byte);
    }
}

TEST(JsonText, IsWrittenWithoutWhatDrivesATerminal) {
    const std::string text = "a\x1b\x7f\xC2\x9B\xE2\x80\xAE\xE6\xB0\xB4\xF3\xA0\x81\x81\"\n";
    const std::string written = json_line(nlohmann::ordered_json(text));
    EXPECT_EQ(written, R"("a\u001b\u007f\u009b\u202e)"
                       "\xE6\xB0\xB4"
                       R"(\udb40\udc41\"\n")");
    EXPECT_EQ(parse_json(written), text);
    EXPECT_EQ(json_document({{"a", 1}}), "{\n  \"a\": 1\n}\n");
}

}  // namespace
}  // namespace rddlc
