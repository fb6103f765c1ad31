// The diagnostics of many problems at once.
#pragma once

#include "problems/problem_lookup.hpp"
#include "support/render.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace rddlc::workbench {

struct CheckOutcome {
    bool done = false;
    std::vector<RenderedDiagnostic> diagnostics;

    bool has_errors() const {
        return std::ranges::any_of(diagnostics, &RenderedDiagnostic::is_error);
    }
};

// In parallel, with a progress bar; outcomes in the order of the files. Stops early on an
// interrupt.
std::vector<CheckOutcome> check_many(const std::vector<ProblemFiles>& files);

// The diagnostics of all instances of a problem. Those that several instances share, such as an error
// in the domain, are reported and counted once.
struct CheckedInstances {
    std::size_t instances = 0, without_errors = 0, errors = 0, warnings = 0;
    std::vector<const RenderedDiagnostic*> different;

    CheckedInstances() = default;
    explicit CheckedInstances(std::span<const CheckOutcome> outcomes);

    void add(const CheckedInstances& others);
};

}  // namespace rddlc::workbench
