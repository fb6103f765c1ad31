// Properties about the values of constant tables, for the nodes that read them.
#pragma once

#include "ir/ir.hpp"
#include "vocabulary/range.hpp"

#include <optional>
#include <vector>

namespace rddlc::ir {

// The least and the greatest value; nothing if there are no values, or a nan.
std::optional<Range> range_of(const Table& values);

// Found out when it is first asked for, and then known: many nodes read the same table.
class TableProperties {
  public:
    // The range of constant buffers, whose values do not change while this lives. More may be
    // added.
    std::optional<Range> range(const Program& program, BufferId table);
    // The length of the longest row of a table of where rows begin.
    double longest_row(const Program& program, BufferId table);
    // The largest number of 1 bits in an element of a table of ints.
    double most_ones(const Program& program, BufferId table);
    // Is some element -0.0?
    bool has_negative_zero(const Program& program, BufferId table);

  private:
    struct Properties {
        std::optional<std::optional<Range>> range;
        std::optional<double> longest_row, most_ones;
        std::optional<bool> has_negative_zero;
    };
    Properties& of(BufferId table);

    std::vector<Properties> properties_;  // by BufferId::index
};

}  // namespace rddlc::ir
