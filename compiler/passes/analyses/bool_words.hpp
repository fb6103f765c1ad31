// Whether the values of a loop over objects are bools alone, so that a register holds them for many
// objects: connectives of elements of tables of bools, of what is the same for all objects, and of
// draws with constant probabilities.
#pragma once

#include "ir/analysis.hpp"
#include "ir/ir.hpp"
#include "ir/nest.hpp"

#include <cstdint>
#include <functional>

namespace rddlc::passes {

inline constexpr std::int64_t bools_in_a_word = 64;
// Registers look up bools by their places in tables of at most so many.
inline constexpr std::int64_t most_looked_up_bools = 256;

// Fewer objects fit what a loop over several objects has at once anyway.
bool are_many(const ir::Program& program, const ir::Nest& nest);

// Whether an exists or forall of each object is worth registers of bools.
bool fill_a_row(const ir::Program& program, const ir::Nest& nest);

// `is_element` says which nodes will become elements of tables.
bool is_of_bools(const ir::Program& program, ir::NodeId id, const ir::Nest& nest,
                 const std::function<bool(ir::NodeId)>& is_element = nullptr);
// Whether all values of the loop are: what Loop::as_words says.
bool is_of_words(const ir::Program& program, const ir::Loop& loop);

}  // namespace rddlc::passes
