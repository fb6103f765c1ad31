#include "solvers/cgp/skdecide.hpp"

#include "support/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace rddlc::solvers {

namespace {

struct Known {
    const char* name;
    Function function;
};
constexpr Known known_functions[] = {
    {"sum", Function::HalfSum},         {"aminus", Function::HalfDistance},
    {"mult", Function::Multiply},       {"exp", Function::ScaledExponential},
    {"abs", Function::Absolute},        {"sqrt", Function::Root},
    {"sqrtxy", Function::ScaledLength}, {"squared", Function::Square},
    {"pow", Function::AbsolutePower},   {"one", Function::One},
    {"zero", Function::Zero},           {"inv", Function::Sign},
    {"gt", Function::Greater},          {"asin", Function::ArcSine},
    {"acos", Function::ArcCosine},      {"atan", Function::ArcTangent},
    {"min", Function::Minimum},         {"max", Function::Maximum},
    {"round", Function::Round},         {"floor", Function::Floor},
    {"ceil", Function::Ceiling},
};

// x from [lower, upper], where it is cut, to [least, most].
double mapped(double x, double lower, double upper, double least, double most) {
    if (!(lower < upper)) return least;
    const double part = (std::max(lower, std::min(upper, x)) - lower) / (upper - lower);
    return part * (most - least) + least;
}

// The number of x's bin among `count` equal bins of [-1, 1].
int bin_of_unit(double x, int count) {
    return std::min(static_cast<int>(mapped(x, -1, 1, 0, 1) * count), count - 1);
}

constexpr int most_numbers = 1 << 24;

std::vector<int> numbers_of(const std::string& line, const char* what) {
    std::istringstream words(line);
    std::vector<int> numbers;
    for (std::string word; words >> word;) {
        const bool is_number =
            word.size() < 9 && word.find_first_not_of("0123456789") == std::string::npos;
        if (!is_number) throw Failure(fmt::format("'{}' is not a number of {}", word, what));
        numbers.push_back(std::stoi(word));
    }
    return numbers;
}

std::vector<Function> functions_of(const std::string& line) {
    std::istringstream words(line);
    std::vector<Function> functions;
    for (std::string word; words >> word;) {
        const auto* const found =
            std::find_if(std::begin(known_functions), std::end(known_functions),
                         [&](const Known& known) { return known.name == word; });
        if (found == std::end(known_functions))
            throw Failure(fmt::format("'{}' is not a function of scikit-decide's CGP", word));
        functions.push_back(found->function);
    }
    return functions;
}

// Marks needed nodes by address. Unlike Activity, which counts what scikit-decide computes, this
// leaves out arguments that functions ignore.
std::vector<bool> needed_by_outputs(const Genome& genome, const Activity& activity) {
    std::vector<bool> needed(activity.used.size());
    std::vector<int> open = genome.outputs;
    while (!open.empty()) {
        const auto address = static_cast<std::size_t>(open.back());
        open.pop_back();
        if (needed[address] || !activity.used[address]) continue;
        needed[address] = true;
        if (address < static_cast<std::size_t>(genome.inputs)) continue;
        const Node& node = genome.nodes[address - static_cast<std::size_t>(genome.inputs)];
        open.insert(open.end(), node.arguments.begin(),
                    node.arguments.begin() + info_of(node.function).arity);
    }
    return needed;
}

}  // namespace

std::vector<Function> skdecide_functions() {
    std::vector<Function> functions;
    for (const Known& known : known_functions) functions.push_back(known.function);
    return functions;
}

ProgramScope skdecide_scope(const rddl_simulator& simulator) {
    ProgramScope scope;
    scope.skdecide = true;
    ObservationOptions options;
    options.time = ObservationOptions::Time::Off;
    scope.observations = observation_space(simulator, options);
    scope.actions = action_space(simulator);
    ObservationSpace& space = scope.observations;
    space.has_objects = false;  // an object is its number
    space.features.clear();
    for (ObservationSpace::Column& column : space.columns) {
        if (column.object_count > 0) {
            column.lower = 0;
            column.upper = column.object_count - 1;
            column.object_count = 0;
        }
        column.first_feature = space.frame_size();
        space.features.push_back(column.name);
        ProgramInput input;
        input.name = column.name;
        input.is_known = true;
        scope.inputs.push_back(std::move(input));
    }
    for (const RealHead& head : scope.actions.reals)
        if (head.range != RealHead::Range::Bounded)
            throw Failure(fmt::format(
                "programs of scikit-decide act within bounds, and the action '{}' lacks one",
                scope.actions.names[static_cast<std::size_t>(head.column)]));
    const auto is_of_one_value = [](const CategoryHead& head) {
        return head.group.empty();
    };
    if (scope.actions.max_sub_actions == 0 &&
        std::ranges::all_of(scope.actions.categories, is_of_one_value))
        scope.outputs = scope.actions.names;
    else if (scope.actions.max_sub_actions == 1 && scope.actions.reals.empty())
        scope.outputs = {"choice"};
    else
        throw Failure(
            "programs of scikit-decide make one choice in a step, and an action of this "
            "problem is made of several, or of choices and reals");
    scope.units.push_back({});
    return scope;
}

void read_skdecide_inputs(const ProgramScope& scope, const float* observed,
                          const std::vector<int>& used, double* inputs, std::ptrdiff_t stride) {
    for (const int i : used) {
        const ObservationSpace::Column& column =
            scope.observations.columns[static_cast<std::size_t>(i)];
        constexpr double infinite = std::numeric_limits<double>::infinity();
        inputs[i * stride] =
            mapped(static_cast<double>(observed[i]), column.lower == -infinite ? -1 : column.lower,
                   column.upper == infinite ? 1 : column.upper, -1, 1);
    }
}

void write_skdecide_outputs(const ProgramScope& scope, const double* values, std::ptrdiff_t stride,
                            float* row) {
    const ActionSpace& space = scope.actions;
    for (std::size_t r = 0; r < space.reals.size(); ++r)
        row[r] = static_cast<float>(values[space.reals[r].column * stride]);
    float* const logits = row + space.reals.size();
    std::fill_n(logits, space.logit_count, 0.0f);
    if (space.max_sub_actions > 0) {
        logits[bin_of_unit(values[0], space.logit_count)] = 1;
        return;
    }
    for (const CategoryHead& head : space.categories)
        logits[head.first_logit + bin_of_unit(values[head.column * stride], head.count)] = 1;
}

bool is_skdecide_genome(std::string_view text) {
    std::istringstream first(std::string(text.substr(0, text.find('\n'))));
    int sizes[4], more = 0;
    return first >> sizes[0] >> sizes[1] >> sizes[2] >> sizes[3] && !(first >> more) && first.eof();
}

Genome read_skdecide_genome(std::string_view text) {
    std::istringstream lines{std::string(text)};
    std::string sizes_line, genes_line, names_line;
    std::getline(lines, sizes_line);
    if (!std::getline(lines, genes_line) || !std::getline(lines, names_line))
        throw Failure("it is not complete: sizes, genes and names of functions are three lines");
    const std::vector<int> sizes = numbers_of(sizes_line, "the sizes"),
                           genes = numbers_of(genes_line, "a gene");
    const std::vector<Function> functions = functions_of(names_line);
    if (sizes.size() != 4) throw Failure("its first line does not have four sizes");
    const std::int64_t inputs = sizes[0], outputs = sizes[1];
    const std::int64_t nodes = std::int64_t{sizes[2]} * sizes[3];
    if (inputs + nodes > most_numbers || outputs > most_numbers)
        throw Failure("its sizes are too large");
    constexpr int genes_of_delayed = 1 + arguments_of_delayed;
    if (static_cast<std::int64_t>(genes.size()) != nodes * genes_of_delayed + outputs)
        throw Failure(fmt::format("it has {} genes, and {} nodes and {} outputs need {}",
                                  genes.size(), nodes, outputs,
                                  nodes * genes_of_delayed + outputs));
    Genome genome;
    genome.inputs = static_cast<int>(inputs);
    genome.delayed = true;
    const auto address = [&](int gene) {
        if (gene >= inputs + nodes)
            throw Failure(fmt::format("there is no input and no node {}", gene));
        return gene;
    };
    std::size_t next = 0;
    for (std::int64_t n = 0; n < nodes; ++n) {
        const auto function = static_cast<std::size_t>(genes[next++]);
        if (function >= functions.size())
            throw Failure(fmt::format("node {} has function {}, and there are {}", n, function,
                                      functions.size()));
        Node node;
        node.function = functions[function];
        for (std::size_t a = 0; a < arguments_of_delayed; ++a)
            node.arguments[a] = address(genes[next++]);
        genome.nodes.push_back(node);
    }
    while (next < genes.size()) genome.outputs.push_back(address(genes[next++]));
    return genome;
}

std::string skdecide_genome_text(const Genome& genome) {
    std::string text =
        fmt::format("{} {} {} 1\n", genome.inputs, genome.outputs.size(), genome.nodes.size());
    for (const Node& node : genome.nodes) {
        const auto* const known =
            std::find_if(std::begin(known_functions), std::end(known_functions),
                         [&](const Known& each) { return each.function == node.function; });
        text += fmt::format("{} {} {} ", known - std::begin(known_functions), node.arguments[0],
                            node.arguments[1]);
    }
    for (const int output : genome.outputs) text += fmt::format("{} ", output);
    text += "\n";
    for (const Known& known : known_functions) text += std::string(known.name) + " ";
    return text + "\n";
}

std::string delayed_text(const Genome& genome, const ProgramScope& scope) {
    const Activity activity = activity_of(genome);
    const std::vector<bool> needed = needed_by_outputs(genome, activity);
    const auto name = [&](int address) -> std::string {
        if (address < genome.inputs) return scope.inputs[static_cast<std::size_t>(address)].name;
        return fmt::format("n{}", address - genome.inputs);
    };
    const auto before = [&](int address) -> std::string {
        if (address < genome.inputs) return name(address);
        const bool is_computed = activity.used[static_cast<std::size_t>(address)];
        return is_computed ? "before(" + name(address) + ")" : "0";
    };
    std::string text =
        "# inputs are mapped from their bounds to [-1, 1] and cut there; before(x) "
        "is x of the step before, at first 0\n";
    for (std::size_t n = 0; n < genome.nodes.size(); ++n) {
        const Node& node = genome.nodes[n];
        if (!needed[static_cast<std::size_t>(genome.inputs) + n]) continue;
        text += fmt::format("n{} = {}", n, info_of(node.function).name);
        for (int a = 0; a < info_of(node.function).arity; ++a)
            text += (a == 0 ? "(" : ", ") + before(node.arguments[static_cast<std::size_t>(a)]);
        text += info_of(node.function).arity > 0 ? ")\n" : "\n";
    }
    for (std::size_t o = 0; o < genome.outputs.size(); ++o)
        text += fmt::format("{} = {}\n", scope.outputs[o], name(genome.outputs[o]));
    return text;
}

}  // namespace rddlc::solvers
