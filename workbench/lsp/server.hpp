// The language server: `rddl lsp`.
#pragma once

#include "support/failure.hpp"
#include "support/standard.hpp"

#include <chrono>

namespace rddlc::lsp {

struct ServerOptions {
    Standard standard = Standard::PyRddlGym;
    // Time without input before texts that have changed are checked.
    std::chrono::milliseconds pause{100};
};

// Reads requests from one descriptor and answers on the other until the client says 'exit' or hangs
// up, or until Ctrl-C. Returns success if the client had asked to shut down before, else diagnosed,
// as the protocol demands.
ExitStatus serve(int input, int output, const ServerOptions& options);

}  // namespace rddlc::lsp
