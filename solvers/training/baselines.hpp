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

// Plays the episodes of `options`.
Baselines baselines(const rddl_simulator& simulator, const EpisodeOptions& options,
                    const std::function<bool()>& stops);

// A message if a policy with these returns is no better than a baseline, as far as its episodes
// show, and `advice`, which says what to try. "" if it is better.
std::string complaint_about(const Estimate& learned, const Baselines& baselines,
                            std::string_view advice);

}  // namespace rddlc::solvers
