// The inputs and outputs of a CGP program.
//
// A ground program reads every value that is observed and writes a number for each action value. A
// lifted one is run for each action value by itself, and reads what concerns its objects: f(?x) for
// the action's own objects, means over others, and counts over those that a non-fluent relates to
// them. So it has the same size in every instance, and a program that was found in one acts in
// another.
#pragma once

#include "solvers/spaces/actions.hpp"
#include "solvers/spaces/observations.hpp"

#include <rddl/simulator.h>

#include <cstdint>
#include <string>
#include <vector>

namespace rddlc::solvers {

enum class Lifting { Auto, On, Off };  // Auto: where an action-fluent has several groundings

struct ProgramInput {
    std::string name;
    // The program reads (x - shift) * scale.
    double shift = 0, scale = 1;
    bool is_known = false;  // shift and scale come from bounds, not from what was seen
};

struct ProgramScope {
    bool lifted = false;
    ObservationSpace observations;
    ActionSpace actions;
    std::vector<ProgramInput> inputs;
    std::vector<std::string> outputs;  // names

    // A run of the program: for all action values, or for one.
    struct Unit {
        int output = 0;   // of lifted programs, the only one that counts
        int column = -1;  // of actions; -1: all, output by output
    };
    std::vector<Unit> units;
    // An input of lifted programs: sums of features times factors, plus a number. Units about the
    // same objects read the same one.
    struct Term {
        int feature;  // -1: the factor itself
        double factor;
    };
    std::vector<Term> terms;                // sum by sum
    std::vector<std::size_t> sum_ends;      // of each sum's terms, from the one before
    std::vector<std::int32_t> input_ends;   // of each input's sums, from the one before
    std::vector<std::int32_t> sum_of_unit;  // of input i and unit u at [i * units + u]
    bool plain = false;                     // input i is feature i, and there is one unit
    bool skdecide = false;                  // read and written as skdecide.hpp says

    int input_count() const { return static_cast<int>(inputs.size()); }
    int output_count() const { return static_cast<int>(outputs.size()); }
    int sum_count() const { return static_cast<int>(sum_ends.size()); }
};

// Learns shifts and scales of unbounded inputs by some random episodes; ends early where `stops`
// says so.
ProgramScope program_scope(const rddl_simulator& simulator, Lifting lifting, bool time,
                           std::uint64_t seed, const Stops& stops = {});

// Reads one environment's features: inputs of unit u, input i to inputs[(i * units + u) * stride].
// `sums` is room for sum_count() numbers.
void read_inputs(const ProgramScope& scope, const float* features, const std::vector<int>& used,
                 double* sums, double* inputs, std::ptrdiff_t stride);

// Converts the outputs of a program, output o of unit u at values[(o * units + u) * stride], to a
// row of a ActionDistribution's inputs: the action space's numbers of reals and logits.
void write_outputs(const ProgramScope& scope, const double* values, std::ptrdiff_t stride,
                   float* row);

}  // namespace rddlc::solvers
