// Texts, formatted, and what must hold of each.
#pragma once

#include "format/comments.hpp"
#include "format/format.hpp"
#include "support/render.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace rddlc {

// Fails the test, with the diagnostics, if `text` is not RDDL.
inline std::string formatted(const std::string& text) {
    Sources sources;
    Diagnostics diagnostics;
    const FileId file = sources.add("test.rddl", text);
    const std::optional<std::string> result =
        format_file(sources, file, diagnostics, Standard::Rddlc);
    EXPECT_TRUE(result) << render(diagnostics, sources, {}) << text;
    return result.value_or("");
}

inline std::vector<std::string> sorted_comments(const std::string& text) {
    std::vector<std::string> comments;
    for (const format::Token& token : format::tokens_with_comments(text)) {
        for (const format::CommentAbove& comment : token.above) comments.emplace_back(comment.text);
        comments.insert(comments.end(), token.behind.begin(), token.behind.end());
    }
    std::sort(comments.begin(), comments.end());
    return comments;
}

inline std::vector<std::string> words(const std::string& text) {
    std::vector<std::string> words;
    for (const format::Token& token : format::tokens_with_comments(text))
        words.emplace_back(token.text);
    return words;
}

// Checks the properties of every text; returns the formatted one. (format_file itself throws if the
// syntax tree is another.)
inline std::string expect_sound(const std::string& text) {
    const std::string once = formatted(text);
    EXPECT_EQ(formatted(once), once) << "formatting again changes the text:\n" << text;
    EXPECT_EQ(sorted_comments(once), sorted_comments(text)) << text;
    EXPECT_EQ(words(once), words(text)) << text;
    return once;
}

}  // namespace rddlc
