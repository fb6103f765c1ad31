// SHA-256 (FIPS 180-4): content keys of the cache and of traces, checkable with sha256sum.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace rddlc {

// 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

// Fails if the file cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace rddlc
