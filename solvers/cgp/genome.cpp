#include "solvers/cgp/genome.hpp"

#include <rddl/values/philox.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rddlc::solvers {

bool is_sound(const Genome& genome) {
    if (genome.inputs < 0) return false;
    const std::int64_t first = genome.inputs + std::ssize(genome.constants);
    const std::int64_t all = first + std::ssize(genome.nodes);
    for (std::int64_t n = 0; n < std::ssize(genome.nodes); ++n) {
        const Node& node = genome.nodes[static_cast<std::size_t>(n)];
        if (static_cast<int>(node.function) >= function_count) return false;
        for (const int argument : node.arguments)
            if (argument < 0 || argument >= (genome.delayed ? all : first + n)) return false;
    }
    return std::ranges::all_of(genome.outputs,
                               [&](int output) { return output >= 0 && output < all; });
}

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

// A random address that node `number` may read.
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

bool has_shape(const Genome& genome, const GenomeShape& shape) {
    const auto count = [](const auto& values) {
        return static_cast<std::int64_t>(values.size());
    };
    if (genome.inputs != shape.inputs || genome.delayed != shape.delayed ||
        count(genome.constants) != shape.constants || count(genome.nodes) != shape.nodes ||
        count(genome.outputs) != shape.outputs)
        return false;
    const std::int64_t all = genome.first_node() + count(genome.nodes);
    for (std::int64_t n = 0; n < count(genome.nodes); ++n) {
        const Node& node = genome.nodes[static_cast<std::size_t>(n)];
        if (std::ranges::find(shape.functions, node.function) == shape.functions.end())
            return false;
        const std::int64_t end = genome.delayed ? all : genome.first_node() + n;
        for (const int argument : node.arguments)
            if (argument < 0 || argument >= end) return false;
    }
    return std::ranges::all_of(genome.outputs,
                               [&](int output) { return output >= 0 && output < all; });
}

void mutate(Genome& genome, const GenomeShape& shape, Mutation mutation, const Activity& activity,
            Random& random) {
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
            // In a delayed program a node behind this one has no part unless a later node reads it.
            if (argument < static_cast<std::size_t>(genome.first_node()) + n)
                activity.used[argument] = 1;
        }
    }
    return activity;
}

}  // namespace rddlc::solvers
