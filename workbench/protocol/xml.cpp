#include "protocol/xml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace rddlc::workbench {

namespace {

constexpr std::size_t deepest = 8;  // messages have four levels
constexpr std::string_view blanks = " \t\r\n";

constexpr std::array<std::pair<std::string_view, char>, 5> references{
    {{"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&quot;", '"'}, {"&apos;", '\''}}};

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string with_characters(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        if (text[i] != '&') {
            out += text[i++];
            continue;
        }
        const auto found =
            std::find_if(references.begin(), references.end(),
                         [&](const auto& each) { return text.substr(i).starts_with(each.first); });
        if (found == references.end())
            throw BadMessage(
                "the message has a reference other than &lt; &gt; &amp; &quot; "
                "&apos;");
        out += found->second;
        i += found->first.size();
    }
    return out;
}

class Parser {
  public:
    explicit Parser(std::string_view text) : text_(text) {}

    Element whole() {
        skip_blanks();
        while (text_.substr(at_).starts_with("<?")) {
            skip_behind("?>");
            skip_blanks();
        }
        Element element = read(1);
        skip_blanks();
        if (at_ != text_.size()) refuse("something follows the message's element");
        return element;
    }

  private:
    [[noreturn]] static void refuse(const std::string& why) {
        throw BadMessage("the message is not XML of the protocol: " + why);
    }
    void skip_blanks() { at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size()); }
    void skip_behind(std::string_view end) {
        const std::size_t found = text_.find(end, at_);
        if (found == std::string_view::npos) refuse("a tag has no end");
        at_ = found + end.size();
    }

    // The inside of the tag that begins here.
    std::string_view tag() {
        if (at_ >= text_.size() || text_[at_] != '<') refuse("a tag is missing");
        const std::size_t begin = at_ + 1;
        skip_behind(">");
        return text_.substr(begin, at_ - 1 - begin);
    }

    Element read(std::size_t depth) {
        if (depth > deepest) refuse("its elements are nested too deep");
        std::string_view inside = tag();
        const bool is_empty = inside.ends_with('/');
        if (is_empty) inside.remove_suffix(1);
        Element element;
        element.name = inside.substr(0, inside.find_first_of(blanks));
        if (element.name.empty() || element.name.find_first_of("!?/<&'\"") != std::string::npos)
            refuse(fmt::format("<{}> is not a tag", inside));
        if (!is_empty) read_content(element, depth);
        return element;
    }

    void read_content(Element& element, std::size_t depth) {
        std::string text;
        while (true) {
            const std::size_t next = std::min(text_.find('<', at_), text_.size());
            text += text_.substr(at_, next - at_);
            at_ = next;
            if (!text_.substr(at_).starts_with("</")) {
                element.children.push_back(read(depth + 1));
                continue;
            }
            const std::string_view name = trimmed(tag().substr(1));
            if (name != element.name) refuse(fmt::format("</{}> ends <{}>", name, element.name));
            element.text = with_characters(trimmed(text));
            return;
        }
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

}  // namespace

const Element* Element::child(std::string_view wanted) const {
    const auto found = std::find_if(children.begin(), children.end(),
                                    [&](const Element& each) { return each.name == wanted; });
    return found == children.end() ? nullptr : &*found;
}

const std::string& Element::text_of(std::string_view wanted) const {
    if (const Element* const found = child(wanted)) return found->text;
    throw BadMessage(fmt::format("<{}> has no <{}>", name, wanted));
}

Element parse_element(std::string_view message) {
    return Parser(message).whole();
}

std::string tagged(std::string_view name, std::string_view text) {
    std::string out = fmt::format("<{}>", name);
    for (const char c : text) {
        const auto* const found = std::find_if(references.begin(), references.end(),
                                               [&](const auto& each) { return each.second == c; });
        found == references.end() ? out += c : out += found->first;
    }
    return out + fmt::format("</{}>", name);
}

void MessageFrames::refuse(const std::string& why) {
    throw BadMessage("the message is not XML of the protocol: " + why);
}

// Whether the message ends with the tag whose '>' has come.
bool MessageFrames::end_tag() {
    is_in_tag_ = false;
    if (first_ == '?') return false;
    if (first_ == '/') {
        if (depth_ == 0) refuse("an element ends that has not begun");
        --depth_;
    } else if (last_ != '/') {
        ++depth_;
    }
    return depth_ == 0;
}

bool MessageFrames::scan(char byte) {
    if (is_in_tag_) {
        if (byte == '>') return end_tag();
        if (tag_length_++ == 0) first_ = byte;
        last_ = byte;
        if (first_ == '!') refuse("comments and declarations are not part of it");
        return false;
    }
    if (byte == '<') {
        is_in_tag_ = true;
        tag_length_ = 0;
        first_ = last_ = 0;
    } else if (depth_ == 0 && byte != '\0' && blanks.find(byte) == std::string_view::npos) {
        refuse("text stands outside of elements");
    }
    return false;
}

// Bytes of messages that are over go many at once: one by one, a stream of blanks would take
// quadratic time.
void MessageFrames::add(std::string_view bytes) {
    buffer_.erase(0, begin_);
    scanned_ -= std::exchange(begin_, 0);
    buffer_ += bytes;
}

std::optional<std::string> MessageFrames::next() {
    while (has_more()) {
        const bool is_whole = scan(buffer_[scanned_++]);
        // Blanks, zero bytes and headers between messages are dropped.
        is_open_ = !is_whole && (depth_ > 0 || is_in_tag_);
        if (is_open_ && scanned_ - begin_ > longest_)
            throw BadMessage(fmt::format("the message is longer than {} bytes", longest_));
        if (is_open_) continue;
        const std::size_t begin = std::exchange(begin_, scanned_);
        if (is_whole) return buffer_.substr(begin, scanned_ - begin);
    }
    return std::nullopt;
}

}  // namespace rddlc::workbench
