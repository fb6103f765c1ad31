// Programs of CGP as scikit-decide 1.1 has them: for comparisons, and for programs that were found
// with it.
//
// They differ from ours as follows. A node reads what other nodes computed in the step before, so a
// chain of d nodes answers d - 1 steps late; in the first step of an episode that is 0. (In
// scikit-decide, values also continue from one episode to the next. Here they do not, so that an
// episode depends on nothing before it.) Inputs are mapped from their bounds to [-1, 1] and
// clipped, where -1 and 1 stand for bounds that are missing; bools are -1 and 1. Outputs are mapped
// from [-1, 1] to the bounds of a real, or to as many equal bins as there are values or choices.
#pragma once

#include "solvers/cgp/genome.hpp"
#include "solvers/cgp/scope.hpp"

#include <rddl/simulator.h>

#include <string>
#include <string_view>
#include <vector>

namespace rddlc::solvers {

// sum, aminus, mult, ..., in the order of its numbers.
std::vector<Function> skdecide_functions();

// Throws a Failure where scikit-decide's programs cannot act: reals without two bounds, several
// changes of which each depends on those before.
ProgramScope skdecide_scope(const rddl_simulator& simulator);
// One environment's inputs, input i to inputs[i * stride], from its observed values.
void read_skdecide_inputs(const ProgramScope& scope, const float* observed,
                          const std::vector<int>& used, double* inputs, std::ptrdiff_t stride);
// Interprets outputs as scikit-decide does, in place of write_outputs.
void write_skdecide_outputs(const ProgramScope& scope, const double* values, std::ptrdiff_t stride,
                            float* row);

// A file of scikit-decide: three lines of sizes, genes, and names of functions.
bool is_skdecide_genome(std::string_view text);
// Throws a Failure with a sentence where it is incomplete or makes no sense.
Genome read_skdecide_genome(std::string_view text);
// Ends in the names; scikit-decide reads no further.
std::string skdecide_genome_text(const Genome& genome);

// A line for each node that counts: "n3 = halfsum(before(n1), vel)".
std::string delayed_text(const Genome& genome, const ProgramScope& scope);

}  // namespace rddlc::solvers
