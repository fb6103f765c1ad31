#include "terminal/progress.hpp"

#include "support/program.hpp"
#include "support/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace rddlc::workbench {

Progress::Progress(std::string what, std::int64_t total, bool wanted)
    : what_(std::move(what)),
      total_(std::max<std::int64_t>(total, 1)),
      shown_(wanted && tells_to_screen()) {}

Progress::~Progress() {
    if (drawn_) tell_with_codes("\r\x1b[K");
}

void Progress::advance(std::int64_t amount) {
    if (!shown_) return;
    const std::scoped_lock lock(mutex_);
    done_ += amount;
    draw_in_time();
}

void Progress::reach(std::int64_t done) {
    if (!shown_) return;
    const std::scoped_lock lock(mutex_);
    done_ = done;
    draw_in_time();
}

void Progress::expect(std::int64_t total) {
    const std::scoped_lock lock(mutex_);
    total_ = std::max<std::int64_t>(total, 1);
}

void Progress::draw_in_time() {
    const Clock::time_point now = Clock::now();
    if (now - last_drawn_ < std::chrono::milliseconds(100)) return;
    last_drawn_ = now;
    draw(now);
}

void Progress::draw(Clock::time_point now) {
    constexpr int bar_width = 30;
    const double part = std::min(1.0, static_cast<double>(done_) / static_cast<double>(total_));
    const int filled = static_cast<int>(part * bar_width);
    const double elapsed = std::chrono::duration<double>(now - begin_).count();
    tell_with_codes("\r\x1b[K" + fmt::format("{} [{}{}] {:3.0f} %  {}", printable_line(what_),
                                             std::string(filled, '='),
                                             std::string(bar_width - filled, ' '), 100 * part,
                                             remaining_text(part, elapsed)));
    std::fflush(stderr);
    drawn_ = true;
}

std::string remaining_text(double part, double elapsed) {
    const bool can_tell = part >= 0.01 || (part > 0 && elapsed >= 1);
    return can_tell ? duration_text(elapsed * (1 - part) / part) + " left" : "";
}

std::string duration_text(double seconds) {
    if (seconds < 10) return fmt::format("{:.1f} s", seconds);
    const auto whole = static_cast<long long>(std::min(std::round(seconds), 1e12));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

}  // namespace rddlc::workbench
