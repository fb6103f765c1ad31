// The tables that hold a relation: where its rows begin, and what its entries are.
#pragma once

#include "ir/ir.hpp"

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace rddlc::passes {

class EntryTables {
  public:
    // Adds to the program's buffers and variables.
    explicit EntryTables(ir::Program& program);

    // A constant table of one dimension: one that was made before, if it has the same values.
    ir::BufferId table(const std::string& name, ir::Scalar scalar, std::vector<ir::Value> values,
                       Span span);

    // An index over so many entries. `depth` tells apart those that are bound inside each other.
    ir::VariableId variable(std::int64_t count, std::size_t depth);

  private:
    std::string unused_name(const std::string& wish);

    ir::Program& program_;
    std::set<std::string> names_;
    std::vector<ir::BufferId> made_;
    std::vector<ir::VariableId> variables_;
};

}  // namespace rddlc::passes
