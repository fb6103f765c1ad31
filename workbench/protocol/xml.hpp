// As much XML as the messages of the protocol need: elements, text and character references.
// Attributes are skipped; comments, sections and declarations of types are refused, so that no
// message can be larger than it looks.
#pragma once

#include "support/failure.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::workbench {

// The other side has sent what the protocol does not have; what() is a sentence for it.
struct BadMessage : Failure {
    using Failure::Failure;
};

struct Element {
    std::string name;
    std::string text;  // between its children, without the blanks at both ends
    std::vector<Element> children;

    // The first child of that name; NULL if there is no such child.
    const Element* child(std::string_view name) const;
    // The text of that child. Throws a BadMessage if there is no such child.
    const std::string& text_of(std::string_view name) const;
};

// Reads one element, which may follow a header (<?xml ...?>). Throws a BadMessage.
Element parse_element(std::string_view message);

// "<name>text</name>", with the references that the text needs.
std::string tagged(std::string_view name, std::string_view text);

// Cuts a stream of bytes into messages. A message ends where its element ends, since some programs
// leave out the zero byte behind it.
class MessageFrames {
  public:
    explicit MessageFrames(std::size_t longest) : longest_(longest) {}

    void add(std::string_view bytes);
    // The next whole message, if there is one. Throws a BadMessage where the bytes cannot be the
    // beginning of a message, or where it is longer than `longest` bytes.
    std::optional<std::string> next();
    // Whether a message has begun that has not ended.
    bool is_within_message() const { return is_open_; }
    // Whether next() has not looked at all bytes.
    bool has_more() const { return scanned_ < buffer_.size(); }

  private:
    bool scan(char byte);
    bool end_tag();
    [[noreturn]] static void refuse(const std::string& why);

    std::size_t longest_;
    std::string buffer_;
    std::size_t begin_ = 0, scanned_ = 0;  // of the message, in the buffer
    std::size_t depth_ = 0;                // of elements that are open
    bool is_open_ = false, is_in_tag_ = false;
    std::size_t tag_length_ = 0;
    char first_ = 0, last_ = 0;  // of the tag
};

}  // namespace rddlc::workbench
