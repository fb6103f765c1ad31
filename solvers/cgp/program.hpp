// Genomes made ready to run.
#pragma once

#include "solvers/cgp/genome.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddlc::solvers {

// A genome reduced to the nodes that have a part in the outputs, for any number of lanes at once.
// Nodes of constants alone are computed once, and nodes that compute the same are merged.
class Program {
  public:
    Program() = default;
    explicit Program(const Genome& genome);

    const std::vector<int>& used_inputs() const { return used_inputs_; }
    // Nodes of the genome that have a part in the outputs, whatever is left of them.
    int nodes() const { return nodes_; }
    bool delayed() const { return delayed_; }
    // Numbers of a lane.
    int slots() const { return slots_ + (delayed_ ? slots_ : 0); }
    // Equal programs have equal numbers.
    std::uint64_t hash() const;
    // Lanes of input i stand at inputs + i * input_row; unused inputs are not read. `values` has
    // room for slots() * lanes numbers. Output o's lanes go to outputs + o * lanes. A delayed
    // program finds there the values of the step before, or zeros where an episode begins.
    void run(int lanes, const double* inputs, std::ptrdiff_t input_row, double* values,
             double* outputs) const;

  private:
    struct Instruction {
        Function function;
        std::array<int, 3> arguments;  // slots; negative: input -1 - argument
        bool operator==(const Instruction&) const = default;
    };

    int place_of_constant(double value);
    int place_of_call(const Instruction& call);
    void keep_what_outputs_need();
    void run_one(const double* inputs, std::ptrdiff_t input_row, double* values,
                 double* outputs) const;
    const double* remembered(int lanes, double* values) const;

    std::vector<Instruction> instructions_;  // the k-th writes slot constants + k
    std::vector<double> constants_;
    std::vector<int> outputs_;  // as arguments
    std::vector<int> used_inputs_;
    int nodes_ = 0;
    int slots_ = 0;  // with a value each; of delayed programs, those of the step before follow
    bool delayed_ = false;
};

}  // namespace rddlc::solvers
