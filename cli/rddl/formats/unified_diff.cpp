#include "formats/unified_diff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace rddlc::cli {

namespace {

using Lines = std::vector<std::string_view>;

// Each with its line break, so that a missing one at the end is a difference.
Lines split(std::string_view text) {
    Lines lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
        lines.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    return lines;
}

struct Edit {
    char mark;  // ' ', '-', '+'
    std::string_view line;
};

// E. Myers, "An O(ND) Difference Algorithm and Its Variations", Algorithmica 1, 1986.
class Comparison {
  public:
    Comparison(std::span<const std::string_view> a, std::span<const std::string_view> b)
        : a_(a), b_(b) {}

    std::vector<Edit> edits() {
        for (int d = 0; d <= max_distance; ++d)
            if (advance(d)) return path_back(d);
        return replacement();
    }

  private:
    // Beyond this, the shortest script is not worth its memory.
    static constexpr int max_distance = 4000;

    // The furthest place in `a` on the diagonal k (place in a - place in b) after d edits.
    struct Frontier {
        int d;
        std::vector<int> furthest;

        explicit Frontier(int edits) : d(edits), furthest(2 * edits + 1, -1) {}
        int& operator[](int k) { return furthest[static_cast<std::size_t>(k + d)]; }
        int at(int k) const {
            return k < -d || k > d ? -1 : furthest[static_cast<std::size_t>(k + d)];
        }
    };

    bool is_end(int x, int k) const { return x >= size(a_) && x - k >= size(b_); }
    static int size(std::span<const std::string_view> lines) {
        return static_cast<int>(lines.size());
    }

    static bool is_insertion(const Frontier& last, int k) {
        return last.at(k - 1) + 1 < last.at(k + 1) + 1 || last.at(k - 1) < 0;
    }

    bool advance(int d) {
        Frontier next(d);
        bool found = false;
        for (int k = -d; k <= d && !found; k += 2) {
            int x = 0;
            if (d > 0) {
                const Frontier& last = frontiers_.back();
                x = is_insertion(last, k) ? last.at(k + 1) : last.at(k - 1) + 1;
                if (x < 0 || x > size(a_) || x - k > size(b_)) continue;
            }
            while (x < size(a_) && x - k < size(b_) && a_[x] == b_[x - k]) ++x;
            next[k] = x;
            found = is_end(x, k);
            end_ = k;
        }
        frontiers_.push_back(std::move(next));
        return found;
    }

    std::vector<Edit> path_back(int d) const {
        std::vector<Edit> edits;
        int k = end_, x = size(a_);
        for (; d > 0; --d) {
            const Frontier& last = frontiers_[static_cast<std::size_t>(d - 1)];
            const bool inserts = is_insertion(last, k);
            const int before = inserts ? last.at(k + 1) : last.at(k - 1);
            for (const int begin = inserts ? before : before + 1; x > begin; --x)
                edits.push_back({' ', a_[x - 1]});
            k += inserts ? 1 : -1;
            edits.push_back(inserts ? Edit{'+', b_[before - k]} : Edit{'-', a_[before]});
            x = before;
        }
        for (; x > 0; --x) edits.push_back({' ', a_[x - 1]});
        std::reverse(edits.begin(), edits.end());
        return edits;
    }

    std::vector<Edit> replacement() const {
        std::vector<Edit> edits;
        for (const std::string_view line : a_) edits.push_back({'-', line});
        for (const std::string_view line : b_) edits.push_back({'+', line});
        return edits;
    }

    std::span<const std::string_view> a_, b_;
    std::vector<Frontier> frontiers_;
    int end_ = 0;  // the diagonal on which the last frontier ended
};

std::string hunk(std::span<const Edit> edits, std::size_t old_line, std::size_t new_line) {
    std::size_t old_count = 0, new_count = 0;
    std::string text;
    for (const Edit& edit : edits) {
        old_count += edit.mark != '+';
        new_count += edit.mark != '-';
        text += edit.mark;
        text += edit.line;
        if (!edit.line.ends_with('\n')) text += "\n\\ No newline at end of file\n";
    }
    return fmt::format("@@ -{},{} +{},{} @@\n{}", old_line - (old_count == 0), old_count,
                       new_line - (new_count == 0), new_count, text);
}

// Changes with three lines around them; those that are near to each other are one hunk.
std::string hunks(std::span<const Edit> edits) {
    constexpr std::size_t context = 3;
    std::string text;
    std::size_t old_line = 1, new_line = 1, at = 0;
    const auto skip_to = [&](std::size_t end) {
        for (; at < end; ++at) {
            old_line += edits[at].mark != '+';
            new_line += edits[at].mark != '-';
        }
    };
    const auto next_change = [&](std::size_t from) {
        while (from < edits.size() && edits[from].mark == ' ') ++from;
        return from;
    };
    for (std::size_t change = next_change(0); change < edits.size();) {
        skip_to(std::max(at, change - std::min(change, context)));
        std::size_t last = change;
        while (change < edits.size() && change <= last + 2 * context + 1) {
            last = change;
            change = next_change(change + 1);
        }
        const std::size_t end = std::min(last + context + 1, edits.size());
        text += hunk(edits.subspan(at, end - at), old_line, new_line);
        skip_to(end);
    }
    return text;
}

}  // namespace

std::string unified_diff(std::string_view old_name, std::string_view old_text,
                         std::string_view new_name, std::string_view new_text) {
    if (old_text == new_text) return "";
    const Lines old_lines = split(old_text), new_lines = split(new_text);
    const std::vector<Edit> edits = Comparison(old_lines, new_lines).edits();
    return fmt::format("--- {}\n+++ {}\n{}", old_name, new_name, hunks(edits));
}

}  // namespace rddlc::cli
