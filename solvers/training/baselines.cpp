#include "solvers/training/baselines.hpp"

#include "solvers/policies/policy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rddlc::solvers {

namespace {

std::optional<Estimate> returns_of(const rddl_simulator& simulator, const Policy& policy,
                                   const EpisodeOptions& options,
                                   const std::function<bool()>& stops) {
    EpisodeOptions counted = options;
    counted.preconditions = Preconditions::Warn;
    Watch watch;
    watch.stops = stops;
    const Rollouts rollouts = run_episodes(simulator, policy, counted, watch);
    const auto is_finished = [](const Episode& episode) {
        return episode.finished;
    };
    if (!std::ranges::all_of(rollouts.episodes, is_finished)) return std::nullopt;
    const Summary summary = summary_of(rollouts);
    if (summary.illegal_actions > 0 || !std::isfinite(summary.undiscounted_return.mean))
        return std::nullopt;
    return summary.undiscounted_return;
}

std::string text_of(const Estimate& returns) {
    return returns.half_width > 0 ? fmt::format("{:.6g} ± {:.3g}", returns.mean, returns.half_width)
                                  : fmt::format("{:.6g}", returns.mean);
}

// Whether `learned` is greater by more than chance: half of the width of both intervals together.
bool is_better(const Estimate& learned, const Estimate& baseline) {
    return learned.mean - baseline.mean > std::hypot(learned.half_width, baseline.half_width) / 2;
}

}  // namespace

std::string Baselines::text() const {
    std::string out;
    if (noop) out += fmt::format("noop {:.6g}", noop->mean);
    if (random) out += fmt::format("{}random {:.6g}", out.empty() ? "" : "  ", random->mean);
    return out;
}

Baselines baselines(const rddl_simulator& simulator, const EpisodeOptions& options,
                    const std::function<bool()>& stops) {
    return {returns_of(simulator, noop_policy(simulator), options, stops),
            returns_of(simulator, random_policy(simulator, options.seed), options, stops)};
}

std::string complaint_about(const Estimate& learned, const Baselines& baselines,
                            std::string_view advice) {
    std::string others;
    const auto compare = [&](const char* name, const std::optional<Estimate>& baseline) {
        if (!baseline || is_better(learned, *baseline)) return;
        others += fmt::format("{}{} ({})", others.empty() ? "" : " and ", name, text_of(*baseline));
    };
    compare("no-op", baselines.noop);
    compare("random actions", baselines.random);
    if (others.empty()) return {};
    return fmt::format("the best policy ({}) is no better than {}. If better is possible, try {}",
                       text_of(learned), others, advice);
}

}  // namespace rddlc::solvers
