// The state of one client's session, and what each message does to it. Knows nothing of
// descriptors.
#pragma once

#include "lsp/checks.hpp"
#include "lsp/lookup.hpp"
#include "lsp/messages.hpp"
#include "support/standard.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rddlc::lsp {

// The codes of errors that answers have.
inline constexpr int parse_error = -32700, invalid_request = -32600, method_not_found = -32601,
                     invalid_params = -32602, internal_fault = -32603, not_initialized = -32002,
                     request_failed = -32803, request_cancelled = -32800;

class Session {
  public:
    // `is_one_problem`: as for a Workspace.
    explicit Session(Standard standard, bool is_one_problem = false)
        : standard_(standard), workspace_(is_one_problem) {}

    // Answers and notifications, in their order.
    std::vector<Json> handle(const Json& message);
    std::vector<Json> handle_malformed(const std::string& reason) const;
    // The answer to a request that is not handled any more.
    static Json cancelled(const Json& id);

    // Whether texts have changed since the last call.
    bool take_change();
    CheckRequest check_request() const;
    // The diagnostics to publish, without those of texts that have changed since.
    std::vector<Json> publish(Checks checks);

    bool has_ended() const { return has_ended_; }
    bool was_shut_down() const { return phase_ == Phase::ShutDown; }

  private:
    enum class Phase { Start, Running, ShutDown };

    Json answer(const std::string& method, const Json& params);
    void notice(const std::string& method, const Json& params);
    Json initialize(const Json& params);
    FilePtr file_of(const Json& params) const;
    const FileChecks& checks_of(const File& file) const;

    Standard standard_;
    Phase phase_ = Phase::Start;
    bool has_ended_ = false;
    bool has_changed_ = false;
    Workspace workspace_;
    Checks checks_;
};

}  // namespace rddlc::lsp
