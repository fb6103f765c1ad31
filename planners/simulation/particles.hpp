// Possible states of an episode that is observed in part: particles, which are environments of one
// batch (a particle filter; Gordon, Salmond and Smith, 1993). Each goes on by the problem's own
// draws with the actions that were taken, and those stay that observe what was observed.
#pragma once

#include "planners/simulation/random_stream.hpp"
#include "planners/simulation/record_columns.hpp"
#include "solvers/batches/batch.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddlc::planners {

class Particles {
  public:
    // It holds so many environments for each particle.
    static constexpr std::int64_t batches = 3;

    // The horizon is that of batches.
    Particles(const rddl_simulator& simulator, std::int64_t count, std::int64_t horizon);

    // An episode begins: each particle draws its start.
    void begin(RandomStream& stream);
    // A step was made with that action, after which that record was observed.
    void update(const std::byte* action, const std::byte* observation, RandomStream& stream);

    const rddl_batch* batch() const { return particles_.get(); }
    std::int64_t count() const { return static_cast<std::int64_t>(seeds_.size()); }
    // How many of their states are different.
    std::int64_t distinct() const;
    // Whether none of them has met the last observation, so that the nearest ones stay.
    bool is_lost() const { return is_lost_; }

  private:
    void try_step(const std::byte* observation, RandomStream& stream);
    void find_ranges();
    double distance(const std::byte* one, const std::byte* other) const;
    void keep_those_within(double most, RandomStream& stream);
    void keep_nearest(RandomStream& stream);
    void resample();

    const rddl_simulator& simulator_;
    std::size_t action_size_, observation_size_;
    std::vector<RecordColumn> columns_;  // of observations
    std::vector<double> ranges_;         // of reals in the candidates, by column
    bool has_reals_ = false;
    // The particles; copies that make the step; and those of the latter that stay.
    solvers::BatchHandle particles_, steps_, found_;
    std::int64_t found_count_ = 0;
    bool is_lost_ = false;
    std::vector<std::uint64_t> seeds_;
    std::vector<std::uint8_t> causes_;
    std::vector<std::int64_t> sources_;
    std::vector<double> distances_;
    std::vector<std::byte> actions_, observations_;
};

}  // namespace rddlc::planners
