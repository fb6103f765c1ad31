// Bytes as text, for pages and terminals (RFC 4648).
#pragma once

#include <string>
#include <string_view>

namespace rddl::render {

std::string base64(std::string_view bytes);

}  // namespace rddl::render
