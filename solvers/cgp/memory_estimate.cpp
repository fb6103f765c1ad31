#include "solvers/cgp/memory_estimate.hpp"

#include "solvers/action_distribution/memory_estimate.hpp"
#include "solvers/cgp/island.hpp"
#include "support/failure.hpp"
#include "support/memory.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rddlc::solvers {

namespace {

constexpr double bytes_of_remembered = 72;  // in a table of hashes

double bytes_of_environment(const rddl_simulator& simulator, const ProgramScope& scope) {
    const ActionSpace& actions = scope.actions;
    // Observations as they are now, and the first, the minimum and the maximum of the episode.
    double bytes = sizeof(float) * 4.0 * scope.observations.column_count();
    bytes += sizeof(float) * (1.0 * actions.column_count + actions.output_count());
    bytes += sizeof(double) + sizeof(std::uint64_t) + 2.0;  // reward, seed, causes
    return bytes + bytes_of_choice(actions) + bytes_of_distribution(simulator, actions) +
           static_cast<double>(bytes_per_environment(simulator));
}

// The bytes of a program's values for a unit in an episode, shared by all programs.
double bytes_of_lane(const ProgramScope& scope, const CgpOptions& options) {
    const double values = options.constants + options.nodes;
    return sizeof(double) * (1.0 * scope.input_count() + scope.output_count() + values);
}

}  // namespace

std::size_t most_remembered(const CgpOptions& options) {
    const double fitting = static_cast<double>(options.memory_limit) / 8 /
                           (bytes_of_remembered * std::max(options.islands, 1));
    return static_cast<std::size_t>(std::clamp(fitting, 1.0, 0x1p20));
}

CgpMemory memory_of(const rddl_simulator& simulator, const ProgramScope& scope,
                    const CgpOptions& options, std::int64_t islands) {
    double environments = 0, lanes = 0;
    const auto add = [&](const EvaluatorSize& size) {
        const auto programs = static_cast<double>(size.programs),
                   episodes = static_cast<double>(size.episodes);
        environments += programs * episodes;
        lanes += static_cast<double>(episodes_at_once(scope, size.episodes)) *
                 static_cast<double>(scope.units.size()) * (options.skdecide ? 2 * programs : 1);
    };
    for (const EvaluatorSize& size : evaluator_sizes(options)) add(size);
    const double candidates = 2.0 + options.children;  // with the parent and the record
    const double genome = static_cast<double>(options.nodes) * sizeof(Node) +
                          sizeof(double) * 1.0 * options.constants + sizeof(Genome);
    const double made = static_cast<double>(options.generations) * candidates;
    CgpMemory memory;
    memory.environments =
        static_cast<double>(islands) * (environments * bytes_of_environment(simulator, scope) +
                                        lanes * bytes_of_lane(scope, options));
    // Genomes, and programs that are ready to run, which the search for constants has twice.
    memory.programs =
        static_cast<double>(islands) *
        (sizeof(Island) + 3 * candidates * genome +
         bytes_of_remembered * std::min(made, static_cast<double>(most_remembered(options))));
    return memory;
}

void require_memory(const rddl_simulator& simulator, const ProgramScope& scope,
                    const CgpOptions& options, std::int64_t islands) {
    const CgpMemory memory = memory_of(simulator, scope, options, islands);
    const auto limit = static_cast<double>(options.memory_limit);
    if (memory.all() <= limit) return;
    throw Failure(
        fmt::format("CGP would take about {}, more than the limit of {}: {} for the environments "
                    "of {} programs, {} for the programs",
                    memory_text(memory.all()), memory_text(limit), memory_text(memory.environments),
                    (1 + std::int64_t{options.children}) * islands, memory_text(memory.programs)),
        memory.environments > memory.programs
            ? "try a smaller --lambda, --episodes or --islands, or a larger --memory-limit"
            : "try a smaller --cols, --lambda or --islands, or a larger --memory-limit");
}

}  // namespace rddlc::solvers
