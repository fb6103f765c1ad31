#include "lsp/messages.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace rddlc::lsp {
namespace {

std::vector<Incoming> all_of(MessageReader& reader) {
    std::vector<Incoming> messages;
    while (auto message = reader.next()) messages.push_back(std::move(*message));
    return messages;
}

TEST(MessageReaderTest, FindsMessagesThatComeInPieces) {
    const std::string bytes = framed({{"id", 1}}) + framed({{"id", 2}});
    MessageReader reader;
    std::vector<Incoming> messages;
    for (const char byte : bytes) {
        reader.add(std::string_view(&byte, 1));
        for (Incoming& each : all_of(reader)) messages.push_back(std::move(each));
    }
    ASSERT_EQ(messages.size(), 2u);
    EXPECT_EQ(std::get<Json>(messages[0])["id"], 1);
    EXPECT_EQ(std::get<Json>(messages[1])["id"], 2);
}

TEST(MessageReaderTest, HeadersMayHaveOtherFieldsAndAnyCase) {
    MessageReader reader;
    reader.add("Content-Type: x; charset=utf-8\r\ncontent-LENGTH:  2\r\n\r\n{}");
    const auto messages = all_of(reader);
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_TRUE(std::holds_alternative<Json>(messages[0]));
}

TEST(MessageReaderTest, LongMessagesAreSkipped) {
    MessageReader reader;
    const std::size_t length = longest_message + 10;
    reader.add("Content-Length: " + std::to_string(length) + "\r\n\r\n");
    EXPECT_TRUE(std::holds_alternative<Malformed>(*reader.next()));
    const std::string block(1 << 20, 'x');
    std::size_t sent = 0;
    for (; sent + block.size() <= length; sent += block.size()) reader.add(block);
    reader.add(std::string(length - sent, 'x') + framed({{"id", 3}}));
    EXPECT_EQ(std::get<Json>(*reader.next())["id"], 3);
}

TEST(MessageReaderTest, AnyBytesAreSurvived) {
    std::mt19937 random(1);
    const std::string good = framed({{"id", 4}});
    for (int round = 0; round < 2000; ++round) {
        std::string bytes = good + good;
        for (int change = 0; change < 3; ++change)
            bytes[random() % bytes.size()] = static_cast<char>(random());
        MessageReader reader;
        reader.add(bytes);
        all_of(reader);
    }
}

}  // namespace
}  // namespace rddlc::lsp
