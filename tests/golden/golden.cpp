#include "golden.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <vector>

namespace rddlc::testing {
namespace {

using Lines = std::vector<std::string>;

Lines split(const std::string& text) {
    Lines lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    if (!text.empty() && !text.ends_with('\n')) lines.back() += "  <no line break at the end>";
    return lines;
}

struct Edit {
    char mark;  // ' ', '-', '+'
    std::string line;
};

// By the longest common subsequence.
std::vector<Edit> edits(const Lines& a, const Lines& b) {
    std::vector<std::vector<int>> common(a.size() + 1, std::vector<int>(b.size() + 1, 0));
    for (std::size_t i = a.size(); i-- > 0;) {
        for (std::size_t j = b.size(); j-- > 0;) {
            common[i][j] = a[i] == b[j] ? common[i + 1][j + 1] + 1
                                        : std::max(common[i + 1][j], common[i][j + 1]);
        }
    }
    std::vector<Edit> result;
    std::size_t i = 0, j = 0;
    while (i < a.size() || j < b.size()) {
        if (i < a.size() && j < b.size() && a[i] == b[j]) {
            result.push_back({' ', a[i++]});
            ++j;
        } else if (j == b.size() || (i < a.size() && common[i + 1][j] >= common[i][j + 1])) {
            result.push_back({'-', a[i++]});
        } else {
            result.push_back({'+', b[j++]});
        }
    }
    return result;
}

std::string read(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

std::string unified_diff(const std::string& expected, const std::string& actual) {
    if (expected == actual) return "";
    constexpr std::size_t context = 3;
    const std::vector<Edit> all = edits(split(expected), split(actual));
    std::vector<bool> shown(all.size(), false);
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (all[k].mark == ' ') continue;
        const std::size_t end = std::min(k + context + 1, all.size());
        for (std::size_t n = k - std::min(k, context); n < end; ++n) shown[n] = true;
    }
    std::string text;
    std::size_t expected_line = 1, actual_line = 1;
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (shown[k] && (k == 0 || !shown[k - 1])) {
            text += "@@ -" + std::to_string(expected_line) + " +" + std::to_string(actual_line) +
                    " @@\n";
        }
        if (shown[k]) text += all[k].mark + all[k].line + "\n";
        expected_line += all[k].mark != '+';
        actual_line += all[k].mark != '-';
    }
    return text;
}

void expect_golden(const std::filesystem::path& file, const std::string& actual,
                   const std::string& test) {
    const char* update = std::getenv("RDDLC_UPDATE");
    if (update && std::string(update) == "1") {
        std::ofstream(file, std::ios::binary) << actual;
        return;
    }
    const std::string difference = unified_diff(read(file), actual);
    if (difference.empty()) return;
    ADD_FAILURE() << file.string() << " differs (- expected, + actual):\n"
                  << difference << "If the new text is right, accept it: RDDLC_UPDATE=1 ctest -R "
                  << test;
}

}  // namespace rddlc::testing
