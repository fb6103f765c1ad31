// The file "checkpoint" of a run: what it holds is sealed with a checksum.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace rddlc::solvers {

std::string sealed(std::string_view bytes);

// Throws a Failure if the file is not sealed, has more than `largest` bytes, or is not as it was
// written.
std::string read_sealed(const std::filesystem::path& path, std::int64_t largest);

}  // namespace rddlc::solvers
