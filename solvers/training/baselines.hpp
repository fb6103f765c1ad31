// The return of policies that have learned nothing: no-op and random. A learned policy has to
// exceed it.
#pragma once

#include "solvers/evaluation/episodes.hpp"
#include "solvers/evaluation/summary.hpp"

#include <rddl/simulator.h>

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace rddlc::solvers {

// Returns of some episodes. Absent: it was interrupted, is not finite, or breaks a precondition.
struct Baselines {
    std::optional<Estimate> noop, random;

    // "noop -40  random -52"; what is absent is left out.
    std::string text() const;
};

// In the episodes of `options`.
Baselines baselines(const rddl_simulator& simulator, const EpisodeOptions& options,
                    const std::function<bool()>& stops);

// Where a policy with these returns is no better than a baseline, as far as its episodes tell: a
// sentence that says so, and what to try. "" where it is better. `solver` is the one that has
// learned it.
std::string complaint_about(const Estimate& learned, const Baselines& baselines,
                            std::string_view solver);

}  // namespace rddlc::solvers
