// How many objects have each value of a small int, as the fields of one Int.
//
//     sum[o in die](die-field[state.v[o]])   where die-field is 1, 16, 256, ...
//
// The highest bit of each field is 0: no count needs it, and sums do not reach the next field.
#pragma once

#include "ir/builder.hpp"
#include "ir/ir.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace rddlc::passes {

struct ValueCounts {
    ir::NodeId fields;  // Int
    int width;          // bits of a field
    std::int64_t values;
    std::int64_t least_value;  // that of the lowest field
};

// The variable over so many objects that all counts of them use, so that equal ones are one node.
ir::VariableId counted_objects(ir::Program& program, std::int64_t count);

// A value of one object as that of the variable of `counted_objects`.
ir::NodeId value_of_counted(ir::Builder& builder, ir::Program& program, ir::NodeId value,
                            ir::VariableId object);
// Whether it is an int of the state or the action, without aggregations.
bool is_countable(const ir::Builder& builder, ir::NodeId value);

// The name of the tables that the counts read, and the place in the text that needs them.
struct CountedPlace {
    std::string name;
    Span span;
};

// The objects of a variable and the value of each. Nothing if the counts of all values that its
// range allows do not fit into one Int.
std::optional<ValueCounts> count_values(ir::Builder& builder, ir::VariableId object,
                                        ir::NodeId value, const CountedPlace& place);
// Int: the highest bit of each field whose value so many objects have. 1 <= count, and not more
// than there are objects.
ir::NodeId at_least(ir::Builder& builder, const ValueCounts& counts, std::int64_t count);
// Int: how many objects have this value.
ir::NodeId count_of(ir::Builder& builder, const ValueCounts& counts, std::int64_t value);
// Bool: whether one of them has it.
ir::NodeId has_value(ir::Builder& builder, const ValueCounts& counts, std::int64_t value);
// The highest bit of the field of a value.
ir::NodeId bit_of(ir::Builder& builder, const ValueCounts& counts, ir::NodeId value,
                  const CountedPlace& place);

}  // namespace rddlc::passes
