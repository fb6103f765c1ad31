#include "solvers/training/checkpoint_file.hpp"

#include "solvers/files/fingerprint.hpp"
#include "solvers/files/protocol_buffers.hpp"
#include "support/failure.hpp"
#include "support/files.hpp"
#include "support/memory.hpp"

#include <fmt/format.h>

namespace rddlc::solvers {

namespace {

constexpr std::string_view beginning = "rddl checkpoint 1\n";

std::string header_of(std::string_view bytes) {
    std::string header(beginning);
    append_little_endian(header, checksum(bytes), 8);
    return header;
}

}  // namespace

std::string sealed(std::string_view bytes) {
    std::string all = header_of(bytes);
    all += bytes;
    return all;
}

std::string read_sealed(const std::filesystem::path& path, std::int64_t largest) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    // Reading a device would never end. read_file reports a missing file.
    if (is_there(path) && (error || !std::filesystem::is_regular_file(path, error)))
        throw Failure("it is not a regular file");
    if (!error && size > static_cast<std::uintmax_t>(largest))
        throw Failure(fmt::format("it has {}, more than the limit of {}",
                                  memory_text(static_cast<double>(size)),
                                  memory_text(static_cast<double>(largest))),
                      "a larger --memory-limit allows it");
    std::string bytes = read_file(path, static_cast<std::size_t>(largest));
    const std::size_t header = header_of({}).size();
    if (!bytes.starts_with(beginning) || bytes.size() < header)
        throw Failure("it is not a checkpoint, or one of another version of this program");
    const std::string_view body = std::string_view(bytes).substr(header);
    if (!bytes.starts_with(header_of(body)))
        throw Failure("it is damaged: it is not as it was written");
    bytes.erase(0, header);
    return bytes;
}

}  // namespace rddlc::solvers
