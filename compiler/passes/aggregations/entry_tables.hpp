// The tables that hold a relation: where its rows begin, and what its entries are.
#pragma once

#include "ir/ir.hpp"
#include "ir/new_tables.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace rddlc::passes {

class EntryTables {
  public:
    // Adds to the program's buffers and variables.
    explicit EntryTables(ir::Program& program) : program_(program), tables_(program) {}

    // A constant table of one dimension: one that is there already, if it has the same values.
    ir::BufferId table(const std::string& name, ir::Scalar scalar,
                       const std::vector<ir::Value>& values, Span span);

    // An index over so many entries. `depth` distinguishes those that are bound inside each other.
    ir::VariableId variable(std::int64_t count, std::size_t depth);

  private:
    ir::Program& program_;
    ir::NewTables tables_;
    std::vector<ir::VariableId> variables_;
};

}  // namespace rddlc::passes
