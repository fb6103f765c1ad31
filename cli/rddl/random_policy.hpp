// Uniformly random legal actions, reproducible whatever the batch and the number of threads.
//
// Values: booleans, enumerated values and bounded ints uniformly; bounded reals uniformly;
// reals bounded on one side at an exponential distance (mean 1) from the bound; unbounded reals
// standard normal; ints that are not bounded on both sides as the reals, rounded toward the
// inside. With a limit of k non-default values, k values chosen at random are drawn and the
// others keep their default. Preconditions that are not bounds are not looked at.
#pragma once

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddlc::cli {

class RandomPolicy {
  public:
    // `problem` must outlive the policy.
    RandomPolicy(const rddl_problem& problem, std::uint64_t seed);

    // Writes the action record with which `environment` leaves timestep `step`.
    // Depends on seed, environment and step only.
    void act(std::int64_t environment, std::int64_t step, std::byte* action);

  private:
    // One value of the action record and what to draw it from.
    struct Entry {
        enum class Kind : std::uint8_t { Bool, Int, Real } kind;
        std::size_t offset;
        double lower, upper;  // reals, and ints with an infinite bound
        std::int64_t first;   // ints with two bounds: first .. first + count - 1;
        std::uint64_t count;  // 0: not bounded on both sides, or no int fits
    };
    struct Draws;

    static Entry entry_of(const rddl_problem& problem, const rddl_fluent& fluent,
                          std::int64_t grounding);
    void draw(const Entry& entry, const Draws& draws, std::size_t number, std::byte* action) const;

    const rddl_problem* problem_;
    std::uint64_t seed_;
    std::vector<Entry> entries_;
    std::size_t drawn_per_step_;      // at most this many values are not at their default
    std::vector<std::size_t> order_;  // identity between calls; shuffled in part during one
};

}  // namespace rddlc::cli
