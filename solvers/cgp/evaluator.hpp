// Episodes of several programs, side by side in one batch.
#pragma once

#include "solvers/action_distribution/action_distribution.hpp"
#include "solvers/batches/batch.hpp"
#include "solvers/cgp/program.hpp"
#include "solvers/cgp/scope.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace rddlc::solvers {

// Episodes that a program is run for at once, of so many: those whose numbers stay near the
// processor.
std::int64_t episodes_at_once(const ProgramScope& scope, std::int64_t episodes);

// The programs' actions for batches in which each has `episodes` environments, one behind the
// other.
class ProgramActor {
  public:
    // All that is referred to must outlive this.
    ProgramActor(const rddl_simulator& simulator, const ProgramScope& scope, std::int64_t programs,
                 std::int64_t episodes);

    void set_stops(const Stops* stops) { distribution_.set_stops(stops); }

    // Reads rows of the simulator's observed values, writes rows of action values. Programs whose
    // `running` is 0 are left out, their actions are what they were. steps: that each program's
    // episodes have made.
    void act(rddl_batch* batch, std::span<const Program* const> programs,
             std::span<const std::uint8_t> running, const float* observations,
             std::span<const std::int64_t> steps, float* actions);

  private:
    void run(const Program& program, std::size_t number, std::int64_t first, std::int64_t count,
             const float* observations, std::int64_t steps);
    double* room_for(const Program& program, std::size_t number, int lanes, std::int64_t steps);

    const ProgramScope& scope_;
    std::int64_t programs_, episodes_;
    std::int64_t together_;  // episodes_at_once
    ActionDistribution distribution_;
    std::vector<float> features_, outputs_, numbers_, shifts_, spreads_, log_probabilities_;
    std::vector<std::int32_t> indices_;
    std::vector<std::uint8_t> masks_;
    std::vector<double> sums_, inputs_, values_, results_;
    std::vector<std::vector<double>> memories_;  // of delayed programs, in place of values_
};

class Evaluator {
  public:
    // Evaluations end early where `stops`, which must outlive this, says so.
    Evaluator(const rddl_simulator& simulator, const ProgramScope& scope, std::int64_t programs,
              std::int64_t episodes, const Stops* stops = nullptr);

    // Takes at most as many programs as there is room for. Episode e of each begins with seeds[e].
    // Returns and lengths are program by program, as is the reach, unless it is NULL. The reach is
    // the sum over observed values of ln(1 + the episode's maximum minus its minimum), in half
    // widths of the value's bounds, or, without bounds, in 1 + its size in the first state.
    void evaluate(std::span<const Program* const> programs, std::span<const std::uint64_t> seeds,
                  double* returns, double* lengths, double* reach = nullptr);
    std::int64_t episodes() const { return episodes_; }
    std::int64_t room() const { return room_; }

  private:
    void begin_reach();
    void follow_reach();
    void tell_reach(std::int64_t environments, double* reach) const;

    const rddl_simulator& simulator_;
    const ObservationSpace& space_;
    std::int64_t room_, episodes_;
    const Stops* stops_;
    BatchHandle batch_;
    ProgramActor actor_;
    std::vector<float> observations_, actions_;
    std::vector<float> first_, least_, most_;  // of observations, where the reach is asked for
    std::vector<double> rewards_;
    std::vector<std::uint8_t> causes_, ended_, running_;
    std::vector<std::uint64_t> seeds_;
    std::vector<std::int64_t> steps_;
    std::vector<const Program*> programs_;
};

}  // namespace rddlc::solvers
