// The target of libFuzzer.
#include "exercise.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    rddlc::fuzzing::exercise(text, size, 4);
    return 0;
}
