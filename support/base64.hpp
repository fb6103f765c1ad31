// Bytes as text (RFC 4648).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rddlc {

std::string base64(std::string_view bytes);
// The bytes again; blanks and line breaks are skipped. Nothing where the text is not base 64.
std::optional<std::string> base64_decoded(std::string_view text);

}  // namespace rddlc
