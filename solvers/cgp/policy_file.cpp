#include "solvers/cgp/policy_file.hpp"

#include "solvers/batches/batch.hpp"
#include "solvers/cgp/evaluator.hpp"
#include "solvers/cgp/formula.hpp"
#include "solvers/cgp/skdecide.hpp"
#include "solvers/files/fingerprint.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <sstream>
#include <type_traits>

namespace rddlc::solvers {

namespace {

constexpr int file_version = 1;

// Lines of the file, each of which begins with a word that names its content.
class Lines {
  public:
    explicit Lines(std::string_view text) : stream_(std::string(text)) {}

    // The rest of the next line, which begins with this word.
    std::istringstream next(const std::string& word) {
        std::string line;
        do {
            if (!std::getline(stream_, line))
                throw Failure(fmt::format("it is not complete: '{}' is missing", word));
        } while (line.empty() || line.front() == '#');
        std::istringstream rest(line);
        std::string found;
        rest >> found;
        if (found != word) throw Failure(fmt::format("'{}' stands where '{}' should", found, word));
        return rest;
    }
    std::string text(const std::string& word) {
        std::istringstream rest = next(word);
        std::string all;
        std::getline(rest >> std::ws, all);
        return all;
    }
    std::int64_t number(const std::string& word, std::int64_t least, std::int64_t most) {
        std::istringstream rest = next(word);
        return number(rest, word, least, most);
    }
    static std::int64_t number(std::istream& rest, const std::string& word, std::int64_t least,
                               std::int64_t most) {
        return in_whole<std::int64_t>(rest, word, least, most);
    }
    static double real(std::istream& rest, const std::string& word) {
        constexpr double most = std::numeric_limits<double>::max();
        return in_whole<double>(rest, word, -most, most);
    }

  private:
    // The next word, all of which is a number between these: neither 1.7 nor 1e400 is an int.
    template <class Number>
    static Number in_whole(std::istream& rest, const std::string& word, Number least, Number most) {
        std::string text;
        rest >> text;
        Number value{};
        const char* const end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, value);
        if (text.empty() || error != std::errc{} || stop != end || !(value >= least) ||
            !(value <= most))
            throw Failure(
                std::is_integral_v<Number>
                    ? fmt::format("the number behind '{}' is not an int from {} to {}", word, least,
                                  most)
                    : fmt::format("what stands behind '{}' is not a finite number", word));
        return value;
    }

    std::istringstream stream_;
};

// Files of scikit-decide's programs do not say what is seen and done.
void require_problem(const rddl_simulator& simulator, const std::string& domain,
                     const std::string& instance) {
    const rddl_problem& problem = *simulator.problem;
    if (domain != problem.domain || instance != problem.instance)
        throw Failure(fmt::format("it is of the problem {} ({}), not of {} ({})", instance, domain,
                                  problem.instance, problem.domain));
}

struct FoundActor {
    FoundActor(const rddl_simulator& its_simulator, std::shared_ptr<const FoundProgram> its_found,
               std::int64_t environments)
        : simulator(its_simulator),
          found(std::move(its_found)),
          program(found->genome),
          programs(static_cast<std::size_t>(environments), &program),
          running(programs.size(), 1),
          records(simulator),
          actor(simulator, found->scope, environments, 1),
          observations(programs.size() *
                       static_cast<std::size_t>(found->scope.observations.column_count())),
          actions(programs.size() * static_cast<std::size_t>(found->scope.actions.column_count)) {}

    void act(Decision& decision) {
        actor.set_stops(decision.stops);
        require_done(simulator, simulator.get_observation_values(decision.batch, RDDL_FLOAT,
                                                                 observations.data()));
        for (std::size_t i = 0; i < running.size(); ++i) running[i] = decision.running[i];
        actor.act(decision.batch, programs, running, observations.data(), decision.steps,
                  actions.data());
        const auto columns = static_cast<std::size_t>(found->scope.actions.column_count);
        for (std::size_t i = 0; i < running.size(); ++i)
            records.write(actions.data() + i * columns,
                          decision.actions + i * records.record_size());
    }

    const rddl_simulator& simulator;
    std::shared_ptr<const FoundProgram> found;
    Program program;
    std::vector<const Program*> programs;
    std::vector<std::uint8_t> running;
    ActionRecords records;
    ProgramActor actor;
    std::vector<float> observations, actions;
};

// Three lines of scikit-decide's, and perhaps those that program_text has added.
std::shared_ptr<const FoundProgram> read_skdecide_program(const rddl_simulator& simulator,
                                                          std::string_view text) {
    const auto found = std::make_shared<FoundProgram>();
    found->genome = read_skdecide_genome(text);
    const Genome& genome = found->genome;
    std::size_t end = 0;
    for (int line = 0; line < 3 && end != std::string_view::npos; ++line)
        end = text.find('\n', end + (line > 0 ? 1 : 0));
    if (end != std::string_view::npos && end + 1 < text.size()) {
        Lines lines(text.substr(end));
        const std::string domain = lines.text("domain"), instance = lines.text("instance");
        require_problem(simulator, domain, instance);
        lines.next("end");
    }
    found->scope = skdecide_scope(simulator);
    const ProgramScope& scope = found->scope;
    if (genome.inputs != scope.input_count() ||
        static_cast<int>(genome.outputs.size()) != scope.output_count())
        throw Failure(fmt::format(
            "it has {} inputs and {} outputs, and the problem {} observed values and {} actions",
            genome.inputs, genome.outputs.size(), scope.input_count(), scope.output_count()));
    return found;
}

}  // namespace

bool is_program(std::string_view text) {
    return text.starts_with("rddl-cgp") || is_skdecide_genome(text);
}

std::string program_formula(const ProgramScope& scope, const Genome& genome) {
    return genome.delayed ? delayed_text(genome, scope) : formula_text(simplified(genome), scope);
}

std::string program_text(const rddl_simulator& simulator, const ProgramScope& scope,
                         const Genome& genome) {
    const rddl_problem& problem = *simulator.problem;
    if (genome.delayed)
        return skdecide_genome_text(genome) +
               fmt::format("domain {}\ninstance {}\nend\n", problem.domain, problem.instance);
    std::string text = fmt::format("rddl-cgp {}\ndomain {}\ninstance {}\nlifted {}\ntime {}\n",
                                   file_version, problem.domain, problem.instance,
                                   scope.lifted ? 1 : 0, scope.observations.time ? 1 : 0);
    std::istringstream formula(formula_text(simplified(genome), scope));
    for (std::string line; std::getline(formula, line);) text += "# " + line + "\n";
    text += fmt::format("inputs {}\n", scope.inputs.size());
    for (const ProgramInput& input : scope.inputs)
        text += fmt::format("input {:.17g} {:.17g} {}\n", input.shift, input.scale, input.name);
    text += fmt::format("constants {}\n", genome.constants.size());
    for (const double constant : genome.constants)
        text += fmt::format("constant {:.17g}\n", constant);
    text += fmt::format("nodes {}\n", genome.nodes.size());
    for (const Node& node : genome.nodes)
        text += fmt::format("node {} {} {} {}\n", info_of(node.function).name, node.arguments[0],
                            node.arguments[1], node.arguments[2]);
    text += fmt::format("outputs {}\n", genome.outputs.size());
    for (std::size_t o = 0; o < genome.outputs.size(); ++o)
        text += fmt::format("output {} {}\n", genome.outputs[o], scope.outputs[o]);
    return text + "end\n";
}

std::shared_ptr<const FoundProgram> read_program(const rddl_simulator& simulator,
                                                 std::string_view text) {
    if (is_skdecide_genome(text)) return read_skdecide_program(simulator, text);
    if (!text.starts_with("rddl-cgp ")) throw Failure("it is not a CGP program");
    Lines lines(text);
    constexpr std::int64_t many = 1 << 24;
    const std::int64_t version = lines.number("rddl-cgp", 0, many);
    if (version > file_version)
        throw Failure(fmt::format("it is of version {}, and this program reads versions up to {}",
                                  version, file_version));
    const std::string domain = lines.text("domain"), instance = lines.text("instance");
    const bool lifted = lines.number("lifted", 0, 1) != 0, time = lines.number("time", 0, 1) != 0;
    // A program suits every instance with the same spaces; a lifted program suits every instance of
    // the domain.
    if (domain != simulator.problem->domain)
        throw Failure(
            fmt::format("it is of the domain {}, not of {}", domain, simulator.problem->domain));
    const auto found = std::make_shared<FoundProgram>();
    found->scope = program_scope(simulator, lifted ? Lifting::On : Lifting::Off, time, 0);
    ProgramScope& scope = found->scope;
    Genome& genome = found->genome;
    const auto other = [&] {
        return Failure(fmt::format(
            "it was learned in {}, whose observations or actions differ from those of {}", instance,
            simulator.problem->instance));
    };
    if (lines.number("inputs", 0, many) != scope.input_count()) throw other();
    for (ProgramInput& input : scope.inputs) {
        std::istringstream rest = lines.next("input");
        input.shift = Lines::real(rest, "input");
        input.scale = Lines::real(rest, "input");
        std::string name;
        std::getline(rest >> std::ws, name);
        if (name != input.name) throw other();
    }
    genome.inputs = scope.input_count();
    // They get room line by line: a file says how many there are before it shows them.
    const std::int64_t constants = lines.number("constants", 0, many);
    for (std::int64_t c = 0; c < constants; ++c) {
        std::istringstream rest = lines.next("constant");
        genome.constants.push_back(Lines::real(rest, "constant"));
    }
    const std::int64_t nodes = lines.number("nodes", 0, many);
    for (std::int64_t n = 0; n < nodes; ++n) {
        std::istringstream rest = lines.next("node");
        std::string name;
        rest >> name;
        const auto function = function_named(name);
        if (!function) throw Failure(fmt::format("'{}' is not a CGP function", name));
        Node& node = genome.nodes.emplace_back();
        node.function = *function;
        for (int& argument : node.arguments)
            argument = static_cast<int>(
                Lines::number(rest, "node", 0, genome.first_node() + static_cast<int>(n) - 1));
    }
    if (lines.number("outputs", 0, many) != scope.output_count()) throw other();
    for (const std::string& output : scope.outputs) {
        std::istringstream rest = lines.next("output");
        genome.outputs.push_back(static_cast<int>(Lines::number(
            rest, "output", 0, genome.first_node() + static_cast<int>(genome.nodes.size()) - 1)));
        std::string name;
        std::getline(rest >> std::ws, name);
        if (name != output) throw other();
    }
    lines.next("end");
    return found;
}

Policy program_policy(const rddl_simulator& simulator, std::shared_ptr<const FoundProgram> program,
                      std::string name) {
    return {std::move(name), spaces_of(simulator),
            [&simulator, program](std::int64_t environments) -> Actor {
                const auto actor = std::make_shared<FoundActor>(simulator, program, environments);
                return [actor](Decision& decision) {
                    actor->act(decision);
                };
            }};
}

}  // namespace rddlc::solvers
