// The target of libFuzzer for files beside RDDL. The first byte of an input says of which kind the
// others are.
#include "exercise_file.hpp"

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace rddlc::fuzzing;
    // Several may run side by side.
    static FileReaders readers(
        RDDL_FUZZED_PROBLEM, RDDL_PLAIN_PROBLEM,
        std::filesystem::temp_directory_path() / ("fuzz_files." + std::to_string(getpid())));
    if (size == 0 || data[0] < 'a' || data[0] >= 'a' + static_cast<int>(file_kinds)) return 0;
    readers.read(static_cast<FileKind>(data[0] - 'a'),
                 {reinterpret_cast<const char*>(data) + 1, size - 1});
    return 0;
}
