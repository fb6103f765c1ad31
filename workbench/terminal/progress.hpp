// A progress bar on stderr: on a terminal only, so that pipes and logs stay clean.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace rddlc::workbench {

class Progress {
  public:
    // `what` is a verb in its -ing form, `total` the amount of work.
    Progress(std::string what, std::int64_t total, bool wanted = true);
    ~Progress();  // wipes the bar
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    // May be called from several threads, as often as one likes: draws a few times a second.
    void advance(std::int64_t amount = 1);
    // So much is done by now; likewise.
    void reach(std::int64_t done);
    // There is so much work in all, as is known by now.
    void expect(std::int64_t total);

  private:
    using Clock = std::chrono::steady_clock;

    void draw_in_time();
    void draw(Clock::time_point now);

    std::string what_;
    std::int64_t total_;
    bool shown_;
    std::mutex mutex_;
    std::int64_t done_ = 0;
    Clock::time_point begin_ = Clock::now();
    Clock::time_point last_drawn_ = begin_;
    bool drawn_ = false;
};

// "12 s left", when `part` of the work took so many seconds. Empty at the beginning, before the
// first hundredth and the first second, which do not predict the rest.
std::string remaining_text(double part, double elapsed);

// "0.4 s", "12 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

}  // namespace rddlc::workbench
