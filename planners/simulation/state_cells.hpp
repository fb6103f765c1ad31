// Cells of states, by which a search tells what it has not met yet: states that are alike are in
// the same cell.
#pragma once

#include "planners/simulation/random_stream.hpp"
#include "planners/simulation/record_columns.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rddlc::planners {

class StateCells {
  public:
    explicit StateCells(const rddl_simulator& simulator);

    // A number for the cell of each state record that is wanted. Each value is divided into about
    // `bins` parts, between the least and the greatest one of these states, from a random offset
    // on. With less than one bin, only some values are divided, each into two parts.
    void find(const std::byte* states, std::span<const std::uint8_t> wanted, double bins,
              RandomStream& stream, std::vector<std::uint64_t>& cells);

  private:
    // Divides the states by one value.
    void divide(const RecordColumn& column, const std::byte* states,
                std::span<const std::uint8_t> wanted, double bins, RandomStream& stream,
                std::vector<std::uint64_t>& cells);

    std::size_t state_size_;
    std::vector<RecordColumn> columns_;
    std::vector<double> values_;
};

}  // namespace rddlc::planners
