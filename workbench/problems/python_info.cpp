#include "problems/python_info.hpp"

#include <optional>

namespace rddlc::workbench {

namespace {

class Scanner {
  public:
    explicit Scanner(std::string_view text) : text_(text) {}

    bool skip_past(char wanted) {
        const std::size_t found = text_.find(wanted);
        text_.remove_prefix(found == std::string_view::npos ? text_.size() : found + 1);
        return found != std::string_view::npos;
    }

    bool accept(char wanted) {
        skip_blanks();
        if (text_.empty() || text_.front() != wanted) return false;
        text_.remove_prefix(1);
        return true;
    }

    // 'text' or "text"; adjacent literals are one string, as in Python.
    std::optional<std::string> string() {
        std::optional<std::string> out;
        while (true) {
            skip_blanks();
            if (text_.empty() || (text_.front() != '\'' && text_.front() != '"')) return out;
            if (!out) out.emplace();
            const char quote = text_.front();
            text_.remove_prefix(1);
            while (!text_.empty() && text_.front() != quote) *out += character();
            if (!text_.empty()) text_.remove_prefix(1);
        }
    }

  private:
    char character() {
        if (text_.front() == '\\' && text_.size() > 1) text_.remove_prefix(1);
        const char c = text_.front();
        text_.remove_prefix(1);
        return c;
    }

    void skip_blanks() {
        const std::size_t next = text_.find_first_not_of(" \t\r\n");
        text_.remove_prefix(next == std::string_view::npos ? text_.size() : next);
    }

    std::string_view text_;
};

}  // namespace

std::map<std::string, std::string> read_python_info(std::string_view text) {
    Scanner scanner(text);
    std::map<std::string, std::string> info;
    if (!scanner.skip_past('{')) return info;
    while (const auto key = scanner.string()) {
        if (!scanner.accept(':')) break;
        if (auto value = scanner.string()) info.emplace(*key, std::move(*value));
        if (!scanner.accept(',') && !scanner.skip_past(',')) break;
    }
    return info;
}

}  // namespace rddlc::workbench
