// Places of a text: bytes, as the compiler counts, and lines with UTF-16 units, as the protocol
// does.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::lsp {

using Json = nlohmann::json;

// A half-open range of bytes.
struct Place {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;

    // Also just behind it, where the cursor of an editor stands after typing.
    bool touches(std::uint32_t offset) const { return begin <= offset && offset <= end; }
    bool contains(Place inner) const { return begin <= inner.begin && inner.end <= end; }
    bool overlaps(Place other) const { return begin <= other.end && other.begin <= end; }
    bool operator==(const Place&) const = default;
};

// A text with the beginnings of its lines, which end at "\n", "\r\n" or a lone "\r".
class Text {
  public:
    explicit Text(std::string text);

    const std::string& string() const { return text_; }
    std::string_view of(Place place) const;

    // {"line": 0-based, "character": UTF-16 units}
    Json position(std::uint32_t offset) const;
    Json range(Place place) const;
    // Positions beyond a line or the text are its end. Throws Json::exception for other JSON.
    std::uint32_t offset(const Json& position) const;
    Place place(const Json& range) const;

  private:
    std::string text_;
    std::vector<std::uint32_t> line_begins_;
};

// "file:///a%20b" -> "/a b"; nothing for other schemes.
std::optional<std::filesystem::path> path_of(std::string_view uri);
std::string uri_of(const std::filesystem::path& path);

}  // namespace rddlc::lsp
