// Rebuilding programs, for passes: every expression goes through a builder again, so that constants
// that a replacement reveals are folded at once, and unused nodes are gone.
#pragma once

#include "ir/builder.hpp"
#include "ir/ir.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>

namespace rddlc::ir {

// Gets a node's old id, and the node with its operands rewritten already; returns its replacement,
// or nothing to keep it.
using Replace = std::function<std::optional<NodeId>(Builder&, NodeId, const Node&)>;

// The program with every reachable node replaced, operands first.
Program rewrite(Program program, const Replace& replace);
// A node with others in place of those below it (or of itself) that are keys of `known`; new
// results are added there.
NodeId replace_in(Builder& builder, NodeId id, std::map<NodeId, NodeId>& known);
// The same if `find` gives the replacement of a node that is not known yet, or nothing to keep it
// with replacements in its operands. So the outermost nodes with a replacement are replaced.
using Find = std::function<std::optional<NodeId>(NodeId)>;
NodeId replace_in(Builder& builder, NodeId id, std::map<NodeId, NodeId>& known, const Find& find);
// The same in all that the CPFs of a step and its reward name.
void replace_in_step(Builder& builder, Program& program, std::map<NodeId, NodeId>& known);
// A value outside of loops in which `find` looks at the outermost reductions alone, and not at
// those in branches, which are not always evaluated.
NodeId replace_reductions_in(Builder& builder, NodeId value, const Find& find);
// The variables, as keys, and their values in the combination of that row-major number.
std::map<NodeId, NodeId> combination(Builder& builder, std::span<const VariableId> variables,
                                     std::int64_t number);
// All parts joined by And or Or, from the first to the last; what changes neither where there are
// no parts. The reverse of parts_of (analysis.hpp).
NodeId joined(Builder& builder, Operator op, std::span<const NodeId> parts);

// Drops unreachable nodes.
Program collect_garbage(Program program);

// Call change(NodeId&) for all that a node, or the statements of a block, or the whole program
// name; in the order of operands_of and roots_of.
using Change = std::function<void(NodeId&)>;
void change_operands(Node& node, const Change& change);
void change_roots(Block& block, const Change& change);
void change_roots(Program& program, const Change& change);

// The same for all buffers that nodes load from, statements read or write, and definitions fill.
void change_buffers(Program& program, const std::function<void(BufferId&)>& change);

}  // namespace rddlc::ir
