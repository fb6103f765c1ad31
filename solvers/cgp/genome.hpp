// Programs as genomes: J. Miller, P. Thomson, "Cartesian genetic programming", 2000. A row of
// nodes, each of which computes a function of inputs, constants and earlier nodes.
//
// Addresses count inputs first, then constants, then nodes.
#pragma once

#include "solvers/cgp/functions.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace rddlc::solvers {

struct Node {
    Function function = Function::Zero;
    std::array<int, 3> arguments{};  // addresses; entries beyond the arity mean nothing
    bool operator==(const Node&) const = default;
};

// A node of a delayed program reads two arguments, whatever its function's arity is.
inline constexpr int arguments_of_delayed = 2;

struct Genome {
    int inputs = 0;
    std::vector<double> constants;
    std::vector<Node> nodes;
    std::vector<int> outputs;  // addresses
    // Nodes read what other nodes computed in the step before, at first 0; inputs are of this step.
    // Then a node may read any other, and itself. So do programs of scikit-decide (skdecide.hpp).
    bool delayed = false;

    int first_node() const { return inputs + static_cast<int>(constants.size()); }
};

// Whether a genome that was read is one: its functions and addresses are there, and unless it is
// delayed, nodes read what stands before them.
bool is_sound(const Genome& genome);

// Random numbers, all of them a function of seed and stream.
class Random {
  public:
    Random(std::uint64_t seed, std::uint64_t stream) : seed_(seed), stream_(stream) {}
    std::uint64_t below(std::uint64_t count);
    double unit();    // in (0, 1)
    double normal();  // standard
    std::uint64_t bits();

  private:
    std::uint64_t seed_, stream_, counter_ = 0;
};

enum class Mutation {
    Single,  // genes at random until one that counts is another (B. Goldman, W. Punch, 2013)
    Gene     // each gene of a node with a probability of 0.1, each output with 0.3
};

struct GenomeShape {
    int inputs = 0, constants = 0, nodes = 0, outputs = 0;
    int levels_back = 0;  // how many nodes before it a node reads at most; 0: all
    std::vector<Function> functions;
    bool delayed = false;
};

Genome random_genome(const GenomeShape& shape, Random& random);
// Whether a genome that was read is one of the shape, with addresses that are there.
bool has_shape(const Genome& genome, const GenomeShape& shape);

// The nodes that have a part in the outputs; `used` marks the inputs and constants that also do.
struct Activity {
    std::vector<std::uint8_t> used;  // by address
    int nodes = 0;
};
Activity activity_of(const Genome& genome);

// `activity` is that of the genome as it is.
void mutate(Genome& genome, const GenomeShape& shape, Mutation mutation, const Activity& activity,
            Random& random);

}  // namespace rddlc::solvers
