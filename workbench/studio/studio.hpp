// The answers of `rddl studio` to its page, without HTTP. A request is a name and a JSON object.
#pragma once

#include "engines/load_simulator.hpp"
#include "studio/edited_problem.hpp"
#include "studio/job.hpp"
#include "studio/tab.hpp"

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

namespace rddlc::studio {

struct StudioOptions {
    workbench::LoadOptions load;  // of episodes that are compared and learned from
};

// Threads may use it at once.
class Studio {
  public:
    Studio(OpenedProblem problem, StudioOptions options);
    // Stops all jobs, and waits for them a short time.
    ~Studio();

    // The answer to the request of that name, such as "step". `body` is the text of a JSON object
    // with the member "tab": tabs know nothing of each other.
    Reply answer(const std::string& name, std::string_view body);

    // Stops all jobs, also those that begin later. Returns whether all have ended in two seconds.
    bool stop();
    // Waits until all jobs have ended by themselves. Returns whether they have in time.
    bool jobs_end(std::chrono::milliseconds longest);

  private:
    std::shared_ptr<Tab> tab_of(const std::string& id);

    const std::shared_ptr<const TabContext> context_;
    std::mutex mutex_;  // of all below
    struct Entry {
        std::shared_ptr<Tab> tab;
        std::uint64_t used = 0;
    };
    std::map<std::string, Entry> tabs_;
    std::uint64_t uses_ = 0;
};

}  // namespace rddlc::studio
