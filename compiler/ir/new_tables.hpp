// Tables that passes add to a program.
#pragma once

#include "ir/ir.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace rddlc::ir {

// Gives a table a dimension for each of these loop indices, in this order.
void set_dimensions(const Program& program, Buffer& table,
                    const std::vector<VariableId>& variables);

// Knows which names are taken and which constant tables exist, so that one more table needs no
// search through all others. Others may also append to the program's buffers.
class NewTables {
  public:
    // The program must outlive this.
    explicit NewTables(Program& program) : program_(program) {}

    // The name, or the name with the first number that no buffer has: "x-2", "x-3", ...
    std::string unused_name(const std::string& wish, std::string_view separator = "-");

    BufferId add(Buffer table);

    // A table that the step fills with the values of an expression, with a dimension for each of
    // these loop indices. It gets the wished name if that is free.
    BufferId scratch(const std::string& wish, Scalar scalar, std::optional<Range> range,
                     const std::vector<VariableId>& variables, Span span);

    // A constant table like this one, if one exists; otherwise a new one. It gets the wished name
    // if that is free.
    BufferId constant(Buffer table);
    // A constant of one dimension.
    BufferId list(const std::string& name, Scalar scalar, const std::vector<Value>& values,
                  Span span);

  private:
    void know_names();
    void know_constants();

    Program& program_;
    std::size_t known_names_ = 0;  // of so many buffers
    std::unordered_set<std::string> names_;
    std::unordered_map<std::string, int> next_number_;            // by wish; lower ones are taken
    std::size_t known_constants_ = 0;                             // among so many buffers
    std::unordered_multimap<std::uint64_t, BufferId> constants_;  // by the hash of their values
};

}  // namespace rddlc::ir
