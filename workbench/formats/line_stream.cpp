#include "formats/line_stream.hpp"

#include "terminal/interrupt.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace rddlc::workbench {

namespace {

constexpr std::size_t bytes_at_once = std::size_t{1} << 18;

Failure unreadable(const std::string& path) {
    return Failure(fmt::format("cannot read '{}': {}", path, std::strerror(errno)));
}

int open_input(const std::string& path) {
    if (path == "-") return STDIN_FILENO;
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) throw unreadable(path);
    return descriptor;
}

}  // namespace

LineReader::LineReader(const std::string& path, UsedFiles& used, std::size_t longest)
    : path_(path == "-" ? "standard input" : path),
      descriptor_(open_input(path)),
      longest_(longest) {
    used.add(descriptor_);
}

LineReader::~LineReader() {
    if (descriptor_ != STDIN_FILENO) close(descriptor_);
}

std::optional<std::string> LineReader::next() {
    if (is_within_long_line_ && !leave_out_rest()) return std::nullopt;
    std::size_t searched = begin_;
    while (true) {
        const std::size_t end = buffer_.find('\n', searched);
        is_within_long_line_ = std::min(end, buffer_.size()) - begin_ > longest_;
        if (is_within_long_line_)
            throw LongLine(fmt::format("the line has more than {} bytes", longest_));
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

// Up to its line break; false if the input ends before. A device has neither.
bool LineReader::leave_out_rest() {
    constexpr std::size_t endless = std::size_t{1} << 32;
    for (std::size_t left_out = 0; left_out < endless; left_out += buffer_.size()) {
        const std::size_t end = buffer_.find('\n', begin_);
        is_within_long_line_ = end == std::string::npos;
        if (!is_within_long_line_) {
            begin_ = end + 1;
            return true;
        }
        buffer_.clear();
        begin_ = 0;
        if (!fill()) return false;
    }
    throw Failure(fmt::format("cannot read '{}': it has a line without end", path_));
}

bool LineReader::fill() {
    const std::size_t old_size = buffer_.size();
    buffer_.resize(old_size + bytes_at_once);
    ssize_t count = 0;
    do {
        count = is_interrupted() ? 0 : read(descriptor_, buffer_.data() + old_size, bytes_at_once);
    } while (count < 0 && errno == EINTR);
    const int error = errno;
    buffer_.resize(old_size + static_cast<std::size_t>(count > 0 ? count : 0));
    errno = error;
    if (count < 0) throw unreadable(path_);
    return count > 0;
}

LineWriter::LineWriter(const std::string& path, const UsedFiles& used)
    : file_(path == "-" ? OutputFile::standard_output(used) : OutputFile(path, used)),
      prompt_(file_.is_stream()) {}

void LineWriter::write(const std::string& lines) {
    buffer_ += lines;
    if (prompt_ || buffer_.size() >= bytes_at_once) flush();
}

void LineWriter::flush() {
    file_.write(buffer_);
    buffer_.clear();
}

void LineWriter::finish() {
    flush();
    file_.finish();
}

}  // namespace rddlc::workbench
