// Broken input of all kinds ends in diagnostics, never in a crash.
#include "parsed.hpp"

#include <gtest/gtest.h>

#include <random>

namespace rddlc {
namespace {

// Every diagnostic can be shown, and its places are places of the file.
void expect_sane(const Parsed& parsed) {
    for (const Diagnostic& diagnostic : parsed.diagnostics.all()) {
        ASSERT_TRUE(diagnostic.span);
        const Span span = *diagnostic.span;
        EXPECT_LE(span.begin, span.end);
        EXPECT_LE(span.end, parsed.sources[span.file].text().size());
        EXPECT_FALSE(diagnostic.message.empty());
    }
    EXPECT_EQ(parsed.report().empty(), parsed.diagnostics.all().empty());
}

TEST(Robustness, TruncatedAtEveryByte) {
    const std::string text = sample_domain + sample_instance;
    // Behind the '}' of a block the text is complete.
    const auto complete = [&](std::size_t length) {
        const std::string head = text.substr(0, length);
        const std::size_t last = head.find_last_not_of(" \n;");
        return last != std::string::npos && head[last] == '}' &&
               (last == 0 || head[last - 1] == '\n') && head.find('{') != std::string::npos;
    };
    for (std::size_t length = 0; length < text.size(); ++length) {
        const Parsed parsed = parse_text(text.substr(0, length));
        expect_sane(parsed);
        EXPECT_EQ(parsed.diagnostics.has_errors(), !complete(length))
            << length << ": ..." << text.substr(length < 30 ? 0 : length - 30, 30) << '\n'
            << parsed.report();
        EXPECT_LE(parsed.diagnostics.error_count(), 2u) << parsed.report();
    }
}

TEST(Robustness, WithEveryByteRemovedOrReplaced) {
    std::mt19937 random(1);
    const std::string text = sample_domain + sample_instance;
    const std::string marks = "(){}[];:,=~^|'?@_-+*/<>!#\"a0. \n\x80";
    for (std::size_t at = 0; at < text.size(); at += 7) {
        std::string removed = text, replaced = text;
        removed.erase(at, 1);
        replaced[at] = marks[random() % marks.size()];
        expect_sane(parse_text(removed));
        expect_sane(parse_text(replaced));
    }
}

TEST(Robustness, RandomTokens) {
    std::mt19937 random(2);
    const std::vector<std::string> words = {
        "domain", "instance", "cpfs",   "{",     "}",       "(",      ")",           "[",
        "]",      ";",        ":",      ",",     "=",       "==",     "~",           "if",
        "then",   "else",     "sum",    "_",     "?x",      "@a",     "name",        "p'",
        "1",      "0.5",      "+",      "-",     "*",       "Normal", "Discrete",    "switch",
        "case",   "default",  "$",      "types", "object",  "reward", "1e3",         "&&",
        "'",      "forall",   "argmax", "det",   "inverse", "row",    "non-fluents", "horizon"};
    for (int round = 0; round < 2000; ++round) {
        std::string text = round % 2 == 0 ? "domain d { cpfs { x' = " : "instance i { ";
        for (std::size_t i = 0; i < 40; ++i) text += words[random() % words.size()] + " ";
        const Parsed parsed = parse_text(text);
        expect_sane(parsed);
        EXPECT_TRUE(parsed.diagnostics.has_errors()) << text;
    }
}

TEST(Robustness, RandomBytes) {
    std::mt19937 random(3);
    for (int round = 0; round < 300; ++round) {
        std::string text(random() % 2000, ' ');
        for (char& c : text) c = static_cast<char>(random() % 255 + 1);
        const Parsed parsed = parse_text(text);
        expect_sane(parsed);
        EXPECT_TRUE(parsed.diagnostics.has_errors());
    }
}

TEST(Robustness, EmptyFiles) {
    for (const char* text : {"", " ", "\n\n", "// nothing", "// nothing\n", "\xEF\xBB\xBF"})
        EXPECT_EQ(parse_text(text).codes(), "E0114") << text;
    EXPECT_EQ(parse_files({}).codes(), "");
}

TEST(Robustness, BinaryFiles) {
    EXPECT_EQ(parse_text(std::string("\x7F"
                                     "ELF\0\0\1(((",
                                     10))
                  .codes(),
              "E0107");
    EXPECT_EQ(parse_text(std::string(5, '\0')).codes(), "E0107");
    const std::string utf16("\xff\xfe\x64\0\x6f\0", 6);
    EXPECT_NE(parse_text(utf16).report().find("save it as UTF-8"), std::string::npos);
}

TEST(Robustness, InvalidUtf8) {
    EXPECT_EQ(parse_text("domain d { // \xE9\xFF \xC3\n reward = 1; }").codes(), "");
    EXPECT_EQ(parse_text("domain d { reward = \xE9 + 1; }").codes(), "E0107");
    EXPECT_EQ(parse_text("domain d { reward = a\xC3; }").codes(), "E0107");
}

TEST(Robustness, CarriageReturns) {
    EXPECT_EQ(parse_text("domain d {\r\n // x\r\n reward = 1;\r\n}\r\n").codes(), "");
    EXPECT_EQ(parse_text("domain d {\r // x\r reward = 1;\r}\r").codes(), "");
    const Parsed parsed = parse_text("domain d {\r\n // x\r\n reward = ;\r\n}\r\n");
    EXPECT_EQ(parsed.report(),
              "test.rddl:3:11: error: expected an expression, found ';' [E0101]\n"
              "    3 |  reward = ;\n"
              "      |           ^\n");
}

TEST(Robustness, ManyErrorsAreCut) {
    std::string text = "domain d { cpfs {\n";
    for (int i = 0; i < 1000; ++i) text += "x' = ;\n! #\n";
    const Parsed parsed = parse_text(text + "}; }");
    EXPECT_GE(parsed.diagnostics.error_count(), 20u);
    EXPECT_LE(parsed.diagnostics.error_count(), 60u);
}

}  // namespace
}  // namespace rddlc
