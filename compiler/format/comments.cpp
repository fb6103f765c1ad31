#include "format/comments.hpp"

namespace rddlc::format {

namespace {

constexpr std::uint32_t tab_width = 8;

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_word_end(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c);
}
bool is_word_part(char c) {
    return is_word_end(c) || c == '-' || c == '_';
}

class Reader {
  public:
    explicit Reader(std::string_view text) : text_(text) {
        constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
        while (text.substr(at_).starts_with(byte_order_mark)) at_ += byte_order_mark.size();
    }

    std::vector<Token> read() {
        while (true) {
            skip_blanks();
            if (text_.substr(at_).starts_with("//"))
                read_comment();
            else
                add_token();
            if (!tokens_.empty() && tokens_.back().text.empty()) return std::move(tokens_);
        }
    }

  private:
    void skip_blanks() {
        for (; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (c == '\n' || (c == '\r' && peek(1) != '\n'))
                begin_line();
            else if (c == '\t')
                column_ += tab_width - column_ % tab_width;
            else if (c == ' ' || c == '\r' || c == '\f' || c == '\v')
                ++column_;
            else
                return;
        }
    }

    void begin_line() {
        ++line_breaks_;
        column_ = 0;
    }

    void read_comment() {
        const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
        std::string_view comment = text_.substr(at_, end - at_);
        comment = comment.substr(0, comment.find_last_not_of(" \t\f\v") + 1);
        if (continues_a_comment()) {
            tokens_.back().behind.push_back(comment);
            comment_column_ = column_;
        } else {
            above_.push_back({comment, line_breaks_ > 1});
            comment_column_ = no_column;
        }
        line_breaks_ = 0;
        at_ = end;
    }

    // Whether it is on the line of a token, or below such a comment and in its column.
    bool continues_a_comment() const {
        if (tokens_.empty() || !above_.empty()) return false;
        return line_breaks_ == 0 || (line_breaks_ == 1 && column_ == comment_column_);
    }

    void add_token() {
        const std::size_t length = token_length();
        tokens_.push_back(
            {text_.substr(at_, length), std::move(above_), {}, line_breaks_, column_});
        above_.clear();
        line_breaks_ = 0;
        comment_column_ = no_column;
        at_ += length;
        column_ += static_cast<std::uint32_t>(length);
    }

    char peek(std::size_t ahead) const {
        return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
    }

    // Finds tokens as the lexer of grammar/RDDL.g4 does.
    std::size_t token_length() const {
        const char first = peek(0);
        if (at_ == text_.size()) return 0;
        if (is_digit(first) || (first == '.' && is_digit(peek(1)))) return number_length();
        if (is_word_end(first) || first == '?' || first == '@') return word_length();
        for (const std::string_view mark : {"<=>", "=>", "==", "~=", "<=", ">="})
            if (text_.substr(at_).starts_with(mark)) return mark.size();
        return 1;
    }

    std::size_t number_length() const {
        std::size_t length = digits_at(0);
        if (peek(length) == '.') length += 1 + digits_at(length + 1);
        return length + exponent_length(length);
    }

    std::size_t digits_at(std::size_t begin) const {
        std::size_t length = 0;
        while (is_digit(peek(begin + length))) ++length;
        return length;
    }

    // The length of "e-3" behind a number.
    std::size_t exponent_length(std::size_t begin) const {
        if (peek(begin) != 'e' && peek(begin) != 'E') return 0;
        const bool has_sign = peek(begin + 1) == '+' || peek(begin + 1) == '-';
        const std::size_t mark = has_sign ? 2 : 1;
        const std::size_t digits = digits_at(begin + mark);
        return digits == 0 ? 0 : mark + digits;
    }

    std::size_t word_length() const {
        std::size_t length = 1;
        while (is_word_part(peek(length))) ++length;
        while (length > 1 && !is_word_end(peek(length - 1))) --length;
        return peek(length) == '\'' ? length + 1 : length;
    }

    static constexpr std::uint32_t no_column = UINT32_MAX;

    std::string_view text_;
    std::size_t at_ = 0;
    std::vector<Token> tokens_;
    std::vector<CommentAbove> above_;  // of the next token
    std::uint32_t line_breaks_ = 0;    // since the last token or comment
    std::uint32_t column_ = 0;
    std::uint32_t comment_column_ = no_column;  // of a comment behind the last token
};

}  // namespace

std::vector<Token> tokens_with_comments(std::string_view text) {
    return Reader(text).read();
}

}  // namespace rddlc::format
