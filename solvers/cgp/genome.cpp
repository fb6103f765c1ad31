#include "solvers/cgp/genome.hpp"

#include <rddl/philox.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace rddlc::solvers {

std::uint64_t Random::bits() {
    using namespace rddl::philox;
    const auto words =
        generate<draw_rounds>(Block<std::uint64_t>{counter_ & 0xFFFFFFFF, counter_ >> 32,
                                                   stream_ & 0xFFFFFFFF, stream_ >> 32},
                              Key<std::uint64_t>{seed_ & 0xFFFFFFFF, (seed_ >> 32) ^ 0x434750});
    ++counter_;
    return (words[0] & 0xFFFFFFFF) << 32 | (words[1] & 0xFFFFFFFF);
}
std::uint64_t Random::below(std::uint64_t count) {
    return (bits() >> 32) * count >> 32;
}
double Random::unit() {
    return (static_cast<double>(bits() >> 12) + 0.5) * 0x1p-52;
}
double Random::normal() {
    const double radius = std::sqrt(-2 * std::log(unit()));
    return radius * std::cos(2 * std::numbers::pi * unit());
}

namespace {

// What node `number` may read.
int random_address(const GenomeShape& shape, int number, Random& random) {
    const int leaves = shape.inputs + shape.constants;
    const int nodes = shape.levels_back > 0 ? std::min(number, shape.levels_back) : number;
    const auto chosen = static_cast<int>(random.below(static_cast<std::uint64_t>(leaves + nodes)));
    return chosen < leaves ? chosen : leaves + number - nodes + (chosen - leaves);
}
Function random_function(const GenomeShape& shape, Random& random) {
    return shape.functions[random.below(shape.functions.size())];
}
int random_output(const GenomeShape& shape, Random& random) {
    return static_cast<int>(
        random.below(static_cast<std::uint64_t>(shape.inputs + shape.constants + shape.nodes)));
}

// A small change, sometimes a large one, so that constants find their place and size.
double changed_constant(double constant, Random& random) {
    const double scale = random.below(4) == 0 ? 1 : 0.1;
    return constant + scale * std::max(std::abs(constant), 0.1) * random.normal();
}

// Gene by gene: the functions of nodes and their three arguments, outputs, constants.
constexpr int genes_of_node = 4;

int gene_count(const Genome& genome) {
    return static_cast<int>(genome.nodes.size()) * genes_of_node +
           static_cast<int>(genome.outputs.size() + genome.constants.size());
}

// Whether the gene is another now, and has a part in the outputs.
bool mutate_gene(Genome& genome, const GenomeShape& shape, int gene, const Activity& activity,
                 Random& random) {
    const int of_nodes = static_cast<int>(genome.nodes.size()) * genes_of_node;
    if (gene < of_nodes) {
        const int number = gene / genes_of_node, part = gene % genes_of_node;
        Node& node = genome.nodes[static_cast<std::size_t>(number)];
        const Node before = node;
        if (part == 0)
            node.function = random_function(shape, random);
        else
            node.arguments[static_cast<std::size_t>(part - 1)] =
                random_address(shape, number, random);
        const bool counts = part == 0 || part <= info_of(node.function).arity;
        return counts && !(node == before) &&
               activity.used[static_cast<std::size_t>(genome.first_node() + number)];
    }
    const auto rest = static_cast<std::size_t>(gene - of_nodes);
    if (rest < genome.outputs.size()) {
        const int before = genome.outputs[rest];
        genome.outputs[rest] = random_output(shape, random);
        return genome.outputs[rest] != before;
    }
    const std::size_t constant = rest - genome.outputs.size();
    genome.constants[constant] = changed_constant(genome.constants[constant], random);
    return activity.used[static_cast<std::size_t>(genome.inputs) + constant];
}

}  // namespace

Genome random_genome(const GenomeShape& shape, Random& random) {
    Genome genome;
    genome.inputs = shape.inputs;
    genome.delayed = shape.delayed;
    for (int c = 0; c < shape.constants; ++c) genome.constants.push_back(random.normal());
    for (int n = 0; n < shape.nodes; ++n) {
        Node node;
        node.function = random_function(shape, random);
        for (int& argument : node.arguments) argument = random_address(shape, n, random);
        genome.nodes.push_back(node);
    }
    for (int o = 0; o < shape.outputs; ++o) genome.outputs.push_back(random_output(shape, random));
    return genome;
}

void mutate(Genome& genome, const GenomeShape& shape, Mutation mutation, Random& random) {
    const Activity activity = activity_of(genome);
    const int genes = gene_count(genome);
    if (mutation == Mutation::Single) {
        const auto any = [&] {
            return static_cast<int>(random.below(static_cast<std::uint64_t>(genes)));
        };
        while (!mutate_gene(genome, shape, any(), activity, random)) {
        }
        return;
    }
    const int of_nodes = static_cast<int>(genome.nodes.size()) * genes_of_node;
    for (int gene = 0; gene < genes; ++gene) {
        const bool output =
            gene >= of_nodes && gene < of_nodes + static_cast<int>(genome.outputs.size());
        if (random.unit() < (output ? 0.3 : 0.1))
            mutate_gene(genome, shape, gene, activity, random);
    }
}

Activity activity_of(const Genome& genome) {
    Activity activity;
    activity.used.resize(static_cast<std::size_t>(genome.first_node()) + genome.nodes.size());
    for (const int output : genome.outputs) activity.used[static_cast<std::size_t>(output)] = 1;
    for (std::size_t n = genome.nodes.size(); n-- > 0;) {
        if (!activity.used[static_cast<std::size_t>(genome.first_node()) + n]) continue;
        activity.nodes += 1;
        const Node& node = genome.nodes[n];
        const int read = genome.delayed ? arguments_of_delayed : info_of(node.function).arity;
        for (int a = 0; a < read; ++a) {
            const auto argument =
                static_cast<std::size_t>(node.arguments[static_cast<std::size_t>(a)]);
            // A node behind this one that nobody behind it reads has no part in a delayed program.
            if (argument < static_cast<std::size_t>(genome.first_node()) + n)
                activity.used[argument] = 1;
        }
    }
    return activity;
}

std::uint64_t phenotype_hash(const Genome& genome, const Activity& activity) {
    std::uint64_t hash = 0xCBF29CE484222325;
    const auto add = [&](std::uint64_t number) {
        hash = (hash ^ number) * 0x9E3779B97F4A7C15;
        hash ^= hash >> 29;
    };
    // Nodes count among those that are used, so that where they stand does not matter.
    std::vector<int> numbers(activity.used.size());
    int next = genome.first_node();
    for (std::size_t a = 0; a < numbers.size(); ++a) {
        if (a < static_cast<std::size_t>(genome.first_node())) {
            numbers[a] = static_cast<int>(a);
            if (a >= static_cast<std::size_t>(genome.inputs) && activity.used[a]) {
                add(a);
                add(std::bit_cast<std::uint64_t>(
                    genome.constants[a - static_cast<std::size_t>(genome.inputs)]));
            }
            continue;
        }
        if (!activity.used[a]) continue;
        numbers[a] = next++;
        const Node& node = genome.nodes[a - static_cast<std::size_t>(genome.first_node())];
        add(static_cast<std::uint64_t>(node.function));
        for (int k = 0; k < info_of(node.function).arity; ++k)
            add(static_cast<std::uint64_t>(
                numbers[static_cast<std::size_t>(node.arguments[static_cast<std::size_t>(k)])]));
    }
    for (const int output : genome.outputs)
        add(static_cast<std::uint64_t>(numbers[static_cast<std::size_t>(output)]));
    return hash;
}

Program::Program(const Genome& genome) : constants_(genome.constants), delayed_(genome.delayed) {
    const Activity activity = activity_of(genome);
    const auto first_node = static_cast<std::size_t>(genome.first_node());
    // What a delayed program reads of nodes that have no part in it is 0, as at first.
    if (delayed_) constants_ = {0.0};
    slots_ = static_cast<int>(constants_.size());
    std::vector<int> places(activity.used.size());
    for (std::size_t a = 0; a < places.size(); ++a) {
        const int address = static_cast<int>(a);
        if (address < genome.inputs) {
            places[a] = -1 - address;
            if (activity.used[a]) used_inputs_.push_back(address);
        } else if (a < first_node) {
            places[a] = address - genome.inputs;
        } else if (activity.used[a]) {
            places[a] = slots_++;
        }
    }
    for (std::size_t n = 0; n < genome.nodes.size(); ++n) {
        if (!activity.used[first_node + n]) continue;
        const Node& node = genome.nodes[n];
        Instruction instruction{node.function, {}};
        for (std::size_t k = 0; static_cast<int>(k) < info_of(node.function).arity; ++k)
            instruction.arguments[k] = places[static_cast<std::size_t>(node.arguments[k])];
        instructions_.push_back(instruction);
    }
    for (const int output : genome.outputs)
        outputs_.push_back(places[static_cast<std::size_t>(output)]);
}

void Program::run(int lanes, const double* inputs, std::ptrdiff_t input_row, double* values,
                  double* outputs) const {
    if (lanes == 1) return run_one(inputs, input_row, values, outputs);
    const double* const read = remembered(lanes, values);
    const auto at = [&](int place, const double* nodes) {
        return place < 0 ? inputs + (-1 - place) * input_row : nodes + place * lanes;
    };
    for (std::size_t c = 0; c < constants_.size(); ++c)
        std::fill_n(values + static_cast<std::ptrdiff_t>(c) * lanes, lanes, constants_[c]);
    double* result = values + static_cast<std::ptrdiff_t>(constants_.size()) * lanes;
    for (const Instruction& instruction : instructions_) {
        apply(instruction.function, lanes, at(instruction.arguments[0], read),
              at(instruction.arguments[1], read), at(instruction.arguments[2], read), result);
        result += lanes;
    }
    for (std::size_t o = 0; o < outputs_.size(); ++o)
        std::copy_n(at(outputs_[o], values), lanes,
                    outputs + static_cast<std::ptrdiff_t>(o) * lanes);
}

// The same without loops over one lane, which would cost more than what they do.
void Program::run_one(const double* inputs, std::ptrdiff_t input_row, double* values,
                      double* outputs) const {
    const double* const read = remembered(1, values);
    const auto at = [&](int place, const double* nodes) {
        return place < 0 ? inputs[(-1 - place) * input_row] : nodes[place];
    };
    std::copy(constants_.begin(), constants_.end(), values);
    double* result = values + constants_.size();
    for (const Instruction& instruction : instructions_)
        *result++ = apply(instruction.function, at(instruction.arguments[0], read),
                          at(instruction.arguments[1], read), at(instruction.arguments[2], read));
    for (const int output : outputs_) *outputs++ = at(output, values);
}

// What nodes read: of a delayed program a copy of what the step before has left.
const double* Program::remembered(int lanes, double* values) const {
    if (!delayed_) return values;
    const std::ptrdiff_t count = std::ptrdiff_t{slots_} * lanes;
    std::copy_n(values, count, values + count);
    return values + count;
}

}  // namespace rddlc::solvers
