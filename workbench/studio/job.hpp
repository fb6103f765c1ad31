// Long work in a thread of its own, which the page asks about and can stop.
#pragma once

#include <nlohmann/json.hpp>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

namespace rddlc::studio {

using Json = nlohmann::ordered_json;

// Counts the jobs at work, so that the program can wait for them before it ends.
class Workers {
  public:
    void begin();
    void end();
    // Makes every job stop, also those that begin later.
    void stop_all() { stops_ = true; }
    bool stops() const { return stops_; }
    // Whether all jobs have ended in time.
    bool wait(std::chrono::milliseconds longest);

  private:
    std::atomic<bool> stops_ = false;
    std::mutex mutex_;
    std::condition_variable changed_;
    int count_ = 0;
};

// Shared by the thread and those who ask about it: a job that is replaced ends by itself.
class Job : public std::enable_shared_from_this<Job> {
  public:
    // Returns the result. Asks stops() often; throws a Failure with what went wrong.
    using Work = std::function<Json(Job&)>;

    static std::shared_ptr<Job> start(const std::shared_ptr<Workers>& workers, Work work);

    void stop() { stops_ = true; }
    bool stops() const { return stops_ || workers_->stops(); }
    // Seen by those who ask while it works.
    void report(Json progress);

    bool is_running() const;
    // {"state": "running", "done", "stopped" or "failed", "seconds", "progress", "result", "error"}
    Json status() const;

  private:
    explicit Job(std::shared_ptr<Workers> workers) : workers_(std::move(workers)) {}
    void run(const Work& work);
    void settle(const char* state, Json result, std::string error);

    using Clock = std::chrono::steady_clock;
    const std::shared_ptr<Workers> workers_;
    std::atomic<bool> stops_ = false;
    const Clock::time_point begin_ = Clock::now();
    mutable std::mutex mutex_;  // of all below
    const char* state_ = "running";
    Clock::time_point end_;
    Json progress_, result_;
    std::string error_;
};

}  // namespace rddlc::studio
