// Room in memory.
#pragma once

#include <cstdint>
#include <string>

namespace rddlc {

// Bytes that simulators, or learners, may take where nothing else is asked for.
inline constexpr std::int64_t default_memory_limit = std::int64_t{4} << 30;

// "512 bytes", "1.5 MiB", "4 GiB"
std::string memory_text(double bytes);

}  // namespace rddlc
