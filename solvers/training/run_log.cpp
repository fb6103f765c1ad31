#include "solvers/training/run_log.hpp"

#include "solvers/files/protocol_buffers.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace rddlc::solvers {

namespace {

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        lines.push_back(text.substr(0, end));
        text.remove_prefix(end + 1);
    }
    return lines;
}

// CRC-32C (Castagnoli), as TFRecords have it: rotated, plus a constant.
std::uint32_t masked_crc(std::string_view bytes) {
    std::uint32_t crc = 0xFFFFFFFF;
    for (const char byte : bytes) {
        crc ^= static_cast<unsigned char>(byte);
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0x82F63B78u : 0u);
    }
    return std::rotr(~crc, 15) + 0xA282EAD8;
}

void append_record(std::string& out, const std::string& record) {
    std::string length;
    append_little_endian(length, record.size(), 8);
    out += length;
    append_little_endian(out, masked_crc(length), 4);
    out += record;
    append_little_endian(out, masked_crc(record), 4);
}

std::string number_text(double value) {
    return std::isnan(value) ? "" : fmt::format("{:.9g}", value);
}

}  // namespace

std::size_t RunLog::width() const {
    return static_cast<std::size_t>(std::count(columns_.begin(), columns_.end(), '\n')) + 3;
}

void RunLog::check_loaded() const {
    const bool has_whole_lines = columns_.empty() || columns_.back() == '\n';
    if (!has_whole_lines || numbers_.size() % width() != 0)
        throw Failure("it is damaged: the rows of its log are not complete");
    constexpr double greatest = 9007199254740992;  // 2^53: any count up to it is a double
    for (std::size_t row = 0; row < numbers_.size(); row += width())
        if (const double steps = numbers_[row + 1];
            !(steps >= 0 && steps <= greatest && steps == std::floor(steps)))
            throw Failure("it is damaged: a number of steps in its log is not a count");
}

void RunLog::add(std::int64_t steps, double seconds, double wall_time, const Row& row) {
    if (columns_.empty())
        for (const auto& [name, value] : row) columns_ += name + "\n";
    numbers_.insert(numbers_.end(), {wall_time, static_cast<double>(steps), seconds});
    for (const auto& [name, value] : row) numbers_.push_back(value);
}

std::string RunLog::csv() const {
    std::string text = "time/total_timesteps,time/time_elapsed";
    for (const std::string_view name : lines_of(columns_)) text += fmt::format(",{}", name);
    text += '\n';
    for (std::size_t row = 0; row + width() <= numbers_.size(); row += width()) {
        for (std::size_t c = 1; c < width(); ++c)
            text += (c > 1 ? "," : "") + number_text(numbers_[row + c]);
        text += '\n';
    }
    return text;
}

std::string RunLog::events() const {
    const std::vector<std::string_view> names = lines_of(columns_);
    std::string out, version;
    append_double(version, 1, numbers_.empty() ? 0 : numbers_[0]);
    append_bytes(version, 3, "brain.Event:2");
    append_record(out, version);
    for (std::size_t row = 0; row + width() <= numbers_.size(); row += width()) {
        std::string summary;
        for (std::size_t c = 0; c < names.size(); ++c) {
            const double number = numbers_[row + 3 + c];
            if (std::isnan(number)) continue;
            std::string value;
            append_bytes(value, 1, names[c]);
            append_float(value, 2, static_cast<float>(number));
            append_bytes(summary, 1, value);
        }
        std::string event;
        append_double(event, 1, numbers_[row]);
        append_number(event, 2, static_cast<std::uint64_t>(numbers_[row + 1]));
        append_bytes(event, 5, summary);
        append_record(out, event);
    }
    return out;
}

}  // namespace rddlc::solvers
