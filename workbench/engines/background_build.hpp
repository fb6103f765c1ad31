// A compiled simulator that a thread of its own makes.
#pragma once

#include <rddl/simulator.h>

#include <sys/types.h>

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <stop_token>

namespace rddlc::workbench {

class BackgroundBuild {
  public:
    // Makes the simulator, or throws. On a stop it throws soon, and leaves nothing behind.
    using Build = std::function<std::shared_ptr<const rddl_simulator>(const std::stop_token&)>;
    // Gets the reason, in a line, why there will be no simulator.
    using Report = std::function<void(const std::string&)>;

    // Starts at once. Both functions are called in the thread, and never after a stop has been
    // waited for.
    BackgroundBuild(Build build, Report report);
    ~BackgroundBuild();  // stops
    BackgroundBuild(const BackgroundBuild&) = delete;
    BackgroundBuild& operator=(const BackgroundBuild&) = delete;

    // The simulator, or null: not yet, or never.
    const rddl_simulator* ready() const { return ready_.load(std::memory_order_acquire); }
    // Whether there is a simulator, or there will be none.
    bool is_settled() const { return settled_.load(std::memory_order_acquire); }

    // A forked process lacks the thread of its parent: starts another one there. Cheap elsewhere.
    void revive();
    // Ends the compiler, and returns when it has ended; nothing is built afterwards.
    void stop();

  private:
    void start();
    void run(const std::stop_token& stop);

    Build build_;
    Report report_;
    std::shared_ptr<const rddl_simulator> simulator_;  // set before ready_
    std::atomic<const rddl_simulator*> ready_ = nullptr;
    std::atomic<bool> settled_ = false;
    std::mutex mutex_;   // of all below
    pid_t process_ = 0;  // that has the thread
    std::stop_source stop_;
    // The end of the thread. It is detached, since the thread of a parent process can be neither
    // joined nor detached later.
    std::future<void> ended_;
};

}  // namespace rddlc::workbench
