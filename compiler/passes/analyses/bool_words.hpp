// Whether the values of a loop over objects are bools alone, so that one word holds them for 64
// objects: connectives of elements of tables of bools, and of what is the same for all objects.
#pragma once

#include "ir/analysis.hpp"
#include "ir/ir.hpp"
#include "ir/nest.hpp"

#include <cstdint>
#include <functional>

namespace rddlc::passes {

// Fewer objects fit what a loop over several objects has at once anyway.
bool are_many(const ir::Program& program, const ir::Nest& nest);

// `is_element` says which nodes will become elements of tables.
bool is_of_bools(const ir::Program& program, ir::NodeId id, const ir::Nest& nest,
                 const std::function<bool(ir::NodeId)>& is_element = nullptr);

}  // namespace rddlc::passes
