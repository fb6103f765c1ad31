// The price of each expression, in units of an addition, and the cost of a step.
//
// Passes compare prices to decide whether a rewrite pays (Properties::cost). `rddlc --stats`
// reports the cost of a step before and after each pass, and a pass that makes a step cost more is
// undone.
#pragma once

#include "ir/ir.hpp"

#include <cstdint>

namespace rddlc::ir {

// Prices that fit measured time (benchmarks/cost_model.py). A Select of two branches of at most
// cheap_cost needs no branch; an elementary function, as exp, is a polynomial of about ten terms
// and its reduction; a draw is a block of Philox, and that of a real also a quantile; a step takes
// its call, its random stream and its flags.
inline constexpr double cheap_cost = 6;
inline constexpr double division_cost = 4;
inline constexpr double elementary_cost = 110;
inline constexpr double draw_cost = 20;
inline constexpr double quantile_cost = 190;
inline constexpr double step_cost = 100;
// Operations in whose time a jump takes that the processor has foreseen wrongly.
inline constexpr double mispredicted_jump_cost = 48;
// Iterations that a loop over several objects makes at once: the doubles of an AVX2 register.
inline constexpr double objects_at_once = 4;
// The same where values are bools: some instructions take 64 of them from tables to words and back.
inline constexpr double bools_at_once = 16;
// How many iterations this loop makes at once where one environment runs it.
double iterations_at_once(const Loop& loop);

// The elements of a table that a pass may add: environments need memory for it.
inline constexpr double most_new_elements = 1e6;

double cost_of(Operator op);

// The cost of a node alone: without its operands, and of a Reduce or DiscreteOver without its body,
// but with what joins the values of the body.
double own_cost(const Program& program, const Node& node);

// How often a Reduce or DiscreteOver evaluates its body, on average where rows have different
// lengths; at least 1.
double repetitions(const Program& program, const Node& binder);

// The cost of one step, of its reward and of the tests of the new state, as the emitted code makes
// it: what does not change in a loop is computed before it, and what stands twice in a definition
// is computed once (passes/sharing/share_subexpressions.hpp).
double cost_of_step(const Program& program);

// The cost of one step of a pack of environments, by what it depends on.
struct PackCost {
    double block = 0;  // not the number of lanes: bools, which are the bits of a number, and what
                       // is the same in all lanes
    double unchosen = 0;  // the same of definitions that a pack skips where none of its actions
                          // chooses anything (Definition::unchosen): larger packs skip fewer
    double ints = 0;   // of each lane
    double reals = 0;  // the same
    double draws = 0;  // of each lane, where branches are taken: all that draws
};
PackCost pack_cost_of_step(const Program& program);

}  // namespace rddlc::ir
