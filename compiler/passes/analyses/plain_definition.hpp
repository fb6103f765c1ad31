// The usual form of a definition: one element after the other, in loops over all of them.
#pragma once

#include "ir/ir.hpp"

#include <optional>
#include <vector>

namespace rddlc::passes {

// for o in obj; for p in pair; scratch.x[o, p] = value
struct PlainDefinition {
    // The loop variables by dimension; absent for a dimension of one object.
    std::vector<std::optional<ir::VariableId>> variables;
    ir::NodeId value;
};

// Nothing if the definition is of another form.
std::optional<PlainDefinition> plain_definition(const ir::Program& program,
                                                const ir::Definition& definition);

}  // namespace rddlc::passes
