// The studio as a server of HTTP on this machine alone.
#pragma once

#include "studio/studio.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace rddlc::studio {

struct ServerOptions {
    // 0: one that is free. Absent: the usual one or, where that is taken, one that is free.
    std::optional<int> port;
};

class StudioServer {
  public:
    // Listens from now on, at 127.0.0.1. Throws a Failure if the port is taken.
    StudioServer(std::shared_ptr<Studio> studio, const ServerOptions& options);
    ~StudioServer();

    // The address holds the token, so it is only for the user.
    std::string address() const;
    // Serves until `stops`, which is asked ten times a second. Returns whether all requests and
    // jobs have ended: the caller need not wait for those that have not.
    bool run(const std::function<bool()>& stops);

  private:
    struct Http;
    std::shared_ptr<Studio> studio_;
    std::shared_ptr<Http> http_;
};

}  // namespace rddlc::studio
