// What the values of constant tables tell about the nodes that read them.
#pragma once

#include "ir/ir.hpp"
#include "vocabulary/range.hpp"

#include <optional>
#include <vector>

namespace rddlc::ir {

// The least and the greatest value; none if there are no values, or a nan.
std::optional<Range> range_of(const Table& values);

// Found out when it is first asked for, and then known: many nodes read the same table.
class TableFacts {
  public:
    // Of constant buffers, whose values do not change while this lives. There may come more.
    std::optional<Range> range(const Program& program, BufferId table);
    // Of a table of where rows begin: the length of the longest one.
    double longest_row(const Program& program, BufferId table);
    // Of a table of ints: the most bits that are 1 in one of them.
    double most_ones(const Program& program, BufferId table);
    // Is some element -0.0?
    bool has_negative_zero(const Program& program, BufferId table);

  private:
    struct Facts {
        std::optional<std::optional<Range>> range;
        std::optional<double> longest_row, most_ones;
        std::optional<bool> has_negative_zero;
    };
    Facts& of(BufferId table);

    std::vector<Facts> facts_;  // by BufferId::index
};

}  // namespace rddlc::ir
