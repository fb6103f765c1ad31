// The difference of two texts, as `diff -u` writes it and `patch` reads it.
#pragma once

#include <string>
#include <string_view>

namespace rddlc::cli {

// Empty if the texts are equal.
std::string unified_diff(std::string_view old_name, std::string_view old_text,
                         std::string_view new_name, std::string_view new_text);

}  // namespace rddlc::cli
