#include "line_stream.hpp"

#include "failure.hpp"
#include "interrupt.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace rddlc::cli {

namespace {

constexpr std::size_t chunk = std::size_t{1} << 18;

int open_or_fail(const std::string& path, int flags, const char* verb) {
    const int descriptor = open(path.c_str(), flags | O_CLOEXEC, 0666);
    if (descriptor < 0)
        throw Failure(fmt::format("cannot {} '{}': {}", verb, path, std::strerror(errno)));
    return descriptor;
}

bool is_regular_file(int descriptor) {
    struct stat status {};
    return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

}  // namespace

LineReader::LineReader(const std::string& path)
    : descriptor_(path == "-" ? STDIN_FILENO : open_or_fail(path, O_RDONLY, "read")) {}

LineReader::~LineReader() {
    if (descriptor_ != STDIN_FILENO) close(descriptor_);
}

std::optional<std::string> LineReader::next() {
    std::size_t searched = begin_;
    while (true) {
        const std::size_t end = buffer_.find('\n', searched);
        if (end != std::string::npos) {
            std::string line = buffer_.substr(begin_, end - begin_);
            begin_ = end + 1;
            return line;
        }
        searched = buffer_.size() - begin_;
        buffer_.erase(0, begin_);
        begin_ = 0;
        if (!fill()) break;
    }
    if (buffer_.empty() || is_interrupted()) return std::nullopt;
    return std::exchange(buffer_, {});  // a last line without a line break
}

bool LineReader::fill() {
    const std::size_t old_size = buffer_.size();
    buffer_.resize(old_size + chunk);
    ssize_t count = 0;
    do {
        count = is_interrupted() ? 0 : read(descriptor_, buffer_.data() + old_size, chunk);
    } while (count < 0 && errno == EINTR);
    buffer_.resize(old_size + static_cast<std::size_t>(count > 0 ? count : 0));
    return count > 0;
}

LineWriter::LineWriter(const std::string& path)
    : path_(path),
      descriptor_(path == "-" ? STDOUT_FILENO
                              : open_or_fail(path, O_WRONLY | O_CREAT | O_TRUNC, "write")),
      prompt_(!is_regular_file(descriptor_)) {}

LineWriter::~LineWriter() {
    if (descriptor_ != STDOUT_FILENO) close(descriptor_);
}

void LineWriter::write(const std::string& lines) {
    buffer_ += lines;
    if (prompt_ || buffer_.size() >= chunk) flush();
}

void LineWriter::flush() {
    std::size_t written = 0;
    while (written < buffer_.size()) {
        const ssize_t count =
            ::write(descriptor_, buffer_.data() + written, buffer_.size() - written);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0)
            throw Failure(fmt::format("cannot write '{}': {}", path_, std::strerror(errno)));
        written += static_cast<std::size_t>(count);
    }
    buffer_.clear();
}

}  // namespace rddlc::cli
