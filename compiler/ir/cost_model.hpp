// What evaluating an expression costs, in units of an addition.
//
// Passes ask it whether a rewrite pays (Facts::cost), and `rddlc --stats` reports the cost of a
// step before and after each of them.
#pragma once

#include "ir/ir.hpp"

#include <cstdint>

namespace rddlc::ir {

// Prices. A Select of two branches up to `cheap` needs no branch; an elementary function, as exp,
// is a polynomial of about ten terms and its reduction; a draw is a block of Philox and the
// quantile.
inline constexpr double cheap_cost = 6;
inline constexpr double division_cost = 4;
inline constexpr double elementary_cost = 20;
inline constexpr double draw_cost = 20;
// Iterations that a loop over several objects makes at once: the doubles of an AVX2 register.
inline constexpr double objects_at_once = 4;

double cost_of(Operator op);

// The cost of a node alone: without its operands, and of a Reduce or DiscreteOver without its body,
// but with what joins the values of the body.
double own_cost(const Program& program, const Node& node);

// How often a Reduce or DiscreteOver evaluates its body, on average where rows have different
// lengths; at least 1.
double repetitions(const Program& program, const Reduce& reduce);
double repetitions(const Program& program, const DiscreteOver& discrete);

// The cost of one step, of its reward and of the tests of the new state, as the emitted code makes
// it: what does not change in a loop is computed before it, and what stands twice in a definition
// is computed once (passes/share_subexpressions.hpp).
double cost_of_step(const Program& program);

}  // namespace rddlc::ir
