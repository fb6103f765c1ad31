// Messages of the protocol of IPPC 2011 to 2018: how they are cut out of streams, and their
// numbers.
#include "protocol/protocol_fluents.hpp"
#include "protocol/xml.hpp"
#include "support/base64.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rddlc::workbench {
namespace {

// The sentence with which the bytes are refused.
std::string refusal(const std::string& bytes, std::size_t longest = 1000) {
    try {
        MessageFrames frames(longest);
        frames.add(bytes);
        while (const auto message = frames.next()) parse_element(*message);
    } catch (const BadMessage& error) {
        return error.what();
    }
    return "";
}

TEST(Messages, EndWithTheirElementsHoweverTheyAreCut) {
    const std::string stream =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<a> <b>1 &lt; 2</b>\n<c/> </a>" +
        std::string(1, '\0') + "\n<d/><e x=\"y\">t</e>";
    MessageFrames frames(1000);
    std::vector<Element> found;
    for (const char byte : stream) {
        frames.add({&byte, 1});
        while (const auto message = frames.next()) found.push_back(parse_element(*message));
    }
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found[0].name, "a");
    EXPECT_EQ(found[0].text_of("b"), "1 < 2");
    EXPECT_NE(found[0].child("c"), nullptr);
    EXPECT_EQ(found[1].name, "d");
    EXPECT_EQ(found[2].text, "t");
    EXPECT_FALSE(frames.is_within_message());
}

TEST(Messages, OfOtherKindsAreRefused) {
    EXPECT_EQ(refusal("GET / HTTP/1.1\r\n"),
              "the message is not XML of the protocol: text stands outside of elements");
    EXPECT_EQ(refusal("<a></b>"), "the message is not XML of the protocol: </b> ends <a>");
    EXPECT_EQ(refusal("</a>"),
              "the message is not XML of the protocol: an element ends that has not begun");
    EXPECT_EQ(refusal("<!DOCTYPE a [<!ENTITY b \"c\">]><a>&b;</a>"),
              "the message is not XML of the protocol: comments and declarations are not part of "
              "it");
    EXPECT_NE(refusal("<a>&b;</a>"), "");
    EXPECT_NE(refusal("< a></ a>"), "");
    EXPECT_EQ(refusal("<a>" + std::string(2000, 'x')), "the message is longer than 1000 bytes");
    std::string deep;
    for (int i = 0; i < 100; ++i) deep += "<a>";
    for (int i = 0; i < 100; ++i) deep += "</a>";
    EXPECT_EQ(refusal(deep),
              "the message is not XML of the protocol: its elements are nested too deep");
}

TEST(Messages, RealsAreThoseOfJava) {
    EXPECT_EQ(java_real(0), "0.0");
    EXPECT_EQ(java_real(-47.75), "-47.75");
    EXPECT_EQ(java_real(1e-3), "0.001");
    EXPECT_EQ(java_real(1e-5), "1.0E-5");
    EXPECT_EQ(java_real(-1.25e7), "-1.25E7");
    EXPECT_EQ(java_real(9999999), "9999999.0");
    EXPECT_EQ(java_real(1e300), "1.0E300");
    EXPECT_EQ(java_real(std::nan("")), "NaN");
    EXPECT_EQ(java_real(-HUGE_VAL), "-Infinity");
}

TEST(Messages, TasksAreInBase64) {
    for (const char* text : {"", "d", "do", "dom", "domain\n\xff"})
        EXPECT_EQ(base64_decoded(base64(text)), text);
    EXPECT_EQ(base64("domain"), "ZG9tYWlu");
    EXPECT_EQ(base64_decoded("ZG9t\nYWlu"), "domain");
    for (const char* text : {"Z", "ZG9tYW", "ZG=t", "Z*9t"})
        EXPECT_EQ(base64_decoded(text), std::nullopt) << text;
}

}  // namespace
}  // namespace rddlc::workbench
