// Single random actions, and actions near one that is known.
#pragma once

#include "planners/simulation/random_stream.hpp"
#include "solvers/spaces/actions.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddlc::planners {

class ActionSampler {
  public:
    // The arguments must outlive it.
    ActionSampler(const solvers::ActionSpace& space, const solvers::ActionRecords& records);

    // Writes the record of an action that may be any, legal or not.
    void draw(RandomStream& stream, std::byte* record);
    // Writes that of an action near `centre`: reals differ by a normal number of the deviation
    // `spread`, in half widths of bounds, and few of the other values differ.
    void draw_near(const std::byte* centre, double spread, RandomStream& stream, std::byte* record);

  private:
    std::int32_t any_index(std::size_t place, RandomStream& stream) const;
    void write(std::byte* record);

    const solvers::ActionSpace& space_;
    const solvers::ActionRecords& records_;
    std::vector<float> numbers_, row_;
    std::vector<std::int32_t> indices_;
};

}  // namespace rddlc::planners
