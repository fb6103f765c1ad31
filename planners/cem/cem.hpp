// plan:cem: model predictive control by sampling. Courses of actions are drawn from a distribution,
// played in one batch, and the distribution moves to those that were best: the cross-entropy method
// (Rubinstein, 1999), with the additions of iCEM (Pinneri and others, 2020).
#pragma once

#include "planners/cem/cem_options.hpp"
#include "planners/cem/courses.hpp"
#include "planners/planner/planner.hpp"
#include "planners/simulation/base_policy.hpp"
#include "planners/simulation/futures.hpp"
#include "planners/simulation/luck.hpp"
#include "planners/simulation/meter.hpp"
#include "solvers/spaces/actions.hpp"
#include "solvers/spaces/mending.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rddlc::planners {

class Cem : public Planner {
  public:
    Cem(const Surroundings& surroundings, const CemOptions& options);
    void decide(const Situation& situation, std::byte* action, Thoughts* thoughts) override;

  private:
    enum class Origin { Kept, Policy, Noop, Middle, Sample };
    // What is kept of an episode from one decision to the next.
    struct Memory {
        Memory(const solvers::ActionSpace& space, Spread spread) : distribution(space, spread) {}
        Distribution distribution;
        std::vector<Course> kept;                            // the best first
        std::vector<std::pair<double, double>> kept_values;  // and their errors
        std::size_t kept_count = 0;
        std::int64_t horizon = 0;
    };
    struct Choice {
        std::size_t course;
        double value, error;
        std::int64_t trials;
    };

    Memory& memory_of(const Situation& situation);
    void set_steps(std::int64_t steps);
    void end_by_noop(Course& course, std::int64_t first, std::int64_t steps) const;
    void make_population(Memory& memory, const Situation& situation, Luck& luck, Meter& meter);
    void record_policy(const Situation& situation, Course& course, Meter& meter);
    // Plays lane k by the course courses[k]; the steps that were made, fewer where time is up.
    std::int64_t play(const Situation& situation, std::span<const std::uint32_t> courses,
                      std::int64_t steps, Meter& meter);
    void write_actions(std::span<const std::uint32_t> courses, std::int64_t step);
    void play_tail(const Situation& situation, Meter& meter);
    void draw_lucks(Luck& luck);
    void rank();
    void rank_kept(const Memory& memory);
    void refit(Memory& memory);
    void keep_best(Memory& memory);
    bool needs_more_steps(const Memory& memory, std::int64_t left) const;
    Choice compare(const Situation& situation, Luck& luck, Meter& meter);
    void note_candidates(Thoughts& thoughts, const Choice& chosen) const;
    const std::byte* first_action(std::size_t course) const;
    void move_on(Memory& memory);

    const rddl_simulator& simulator_;
    CemOptions options_;
    solvers::ActionSpace space_;
    solvers::ActionRecords records_;
    std::size_t population_, scenarios_, lanes_;
    Futures futures_;
    solvers::MendingRoom mending_;
    std::optional<BasePolicy> base_, recorder_;  // of all lanes; of one environment
    std::optional<Futures> recording_;
    std::vector<std::optional<Memory>> memories_;
    std::int64_t steps_ = 0;  // of each course
    std::vector<float> default_numbers_;
    std::vector<std::int32_t> default_indices_;

    // Of the population.
    std::vector<Course> courses_;
    std::vector<Origin> origins_;
    std::vector<double> values_, errors_;
    std::vector<std::size_t> order_;  // the best first
    std::vector<std::byte> firsts_;   // action records of each course's first step
    // Of lanes.
    std::vector<std::uint32_t> course_of_lane_, compared_of_lane_;
    std::vector<std::uint64_t> lucks_;
    std::vector<float> rows_;
    std::vector<std::byte> actions_;
    std::vector<std::uint8_t> by_policy_;
    // Of a fit, and of a comparison.
    std::vector<const Course*> fitted_;
    std::vector<double> weights_;
    std::vector<std::size_t> compared_;
    std::vector<double> compared_values_, compared_errors_;
};

}  // namespace rddlc::planners
