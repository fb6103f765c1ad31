// How much a decision may cost, and has cost so far.
#pragma once

#include "solvers/batches/stops.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>

namespace rddlc::planners {

// The first limit that is reached ends the search. Without any limit it is default_seconds.
struct Budget {
    std::optional<double> seconds;
    std::optional<std::int64_t> steps;       // of all simulated environments together
    std::optional<std::int64_t> iterations;  // what a planner repeats
};
inline constexpr double default_seconds = 0.1;

inline std::int64_t share_of(std::int64_t whole, double share) {
    return static_cast<std::int64_t>(share * static_cast<double>(whole));
}
// A part of each limit, the default one included; at least one iteration.
inline Budget share_of(Budget budget, double share) {
    if (!budget.seconds && !budget.steps && !budget.iterations) budget.seconds = default_seconds;
    if (share == 1) return budget;
    if (budget.seconds) *budget.seconds *= share;
    if (budget.steps) budget.steps = share_of(*budget.steps, share);
    if (budget.iterations)
        budget.iterations = std::max<std::int64_t>(1, share_of(*budget.iterations, share));
    return budget;
}

class BudgetMeter {
  public:
    // A search has that part of what `spent` steps have left.
    BudgetMeter(Budget budget, const solvers::Stops* stops, double share = 1,
                std::int64_t spent = 0)
        : stops_(stops), begin_(Clock::now()) {
        if (budget.steps) *budget.steps -= spent;
        budget_ = share_of(budget, share);
    }

    void add_steps(std::int64_t steps) { steps_ += steps; }
    void add_iterations(std::int64_t count = 1) { iterations_ += count; }
    std::int64_t steps() const { return steps_; }
    std::int64_t iterations() const { return iterations_; }
    std::int64_t steps_left() const {
        return budget_.steps ? *budget_.steps - steps_ : std::numeric_limits<std::int64_t>::max();
    }

    bool has_clock() const { return budget_.seconds.has_value(); }
    double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

    // Whether there is room for one more iteration that takes about so much.
    bool has_room(std::int64_t steps, double seconds_more) const {
        return !solvers::is_stopped(stops_) && steps <= steps_left() &&
               (!budget_.seconds || seconds() + seconds_more <= *budget_.seconds) &&
               (!budget_.iterations || iterations_ < *budget_.iterations);
    }
    // The part of the budget that is used up: 1 at its end.
    double used() const {
        double part = solvers::is_stopped(stops_) ? 1 : 0;
        const auto look = [&part](double now, double all) {
            part = std::max(part, now >= all ? 1 : now / all);
        };
        if (budget_.seconds) look(seconds(), *budget_.seconds);
        if (budget_.steps) look(static_cast<double>(steps_), static_cast<double>(*budget_.steps));
        if (budget_.iterations)
            look(static_cast<double>(iterations_), static_cast<double>(*budget_.iterations));
        return part;
    }
    // Whether work has to be left half done: the clock, or Ctrl-C, says so.
    bool is_late() const {
        return solvers::is_stopped(stops_) || (budget_.seconds && seconds() >= *budget_.seconds);
    }
    const solvers::Stops* stops() const { return stops_; }

  private:
    using Clock = std::chrono::steady_clock;
    Budget budget_;
    const solvers::Stops* stops_;
    Clock::time_point begin_;
    std::int64_t steps_ = 0, iterations_ = 0;
};

}  // namespace rddlc::planners
