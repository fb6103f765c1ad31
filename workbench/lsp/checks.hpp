// Diagnostics of files as the compiler finds them, in the words of the protocol.
#pragma once

#include "lsp/workspace.hpp"
#include "support/standard.hpp"

#include <map>
#include <string>
#include <vector>

namespace rddlc::lsp {

// A change that repairs what a diagnostic is about.
struct QuickFix {
    std::string title;
    Json changes;            // by URI: lists of TextEdit
    std::size_t diagnostic;  // index into FileChecks::diagnostics
};

// The diagnostics of one version of a file.
struct FileChecks {
    std::optional<std::int64_t> version;
    std::vector<Json> diagnostics;  // as published
    std::vector<QuickFix> fixes;
};

// The results by URI. Files of the problems without any diagnostic are also there.
using Checks = std::map<std::string, FileChecks>;

// Checks the problems of all open files. Pure, so that it may run beside the server.
struct CheckRequest {
    struct Problem {
        std::vector<FilePtr> inputs;     // domain first
        FilePtr policy;                  // may be null
        FilePtr asked;                   // where diagnostics without a place are shown
        FilePtr other_domain = nullptr;  // the only domain around, if no file has the named one
    };
    std::vector<Problem> problems;
    Standard standard = Standard::PyRddlGym;
};
CheckRequest check_request(const Workspace& workspace, Standard standard);
Checks run_checks(const CheckRequest& request);

}  // namespace rddlc::lsp
