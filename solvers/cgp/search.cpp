#include "solvers/cgp/search.hpp"

#include "solvers/cgp/island.hpp"
#include "solvers/files/checkpoint.hpp"
#include "support/failure.hpp"

#include <rddl/threads.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>

namespace rddlc::solvers {

namespace {

const CheckpointKind checkpoint{"CGP", "rddl cgp checkpoint", 1};
CgpOptions completed(CgpOptions options, const rddl_problem& problem) {
    if (options.episodes == 0) options.episodes = problem.stochastic ? 16 : 1;
    if (options.children == 0) options.children = problem.stochastic ? 8 : 32;
    if (options.episodes > 1 && options.episodes < 4) options.episodes = 4;
    if (options.functions.empty()) throw Failure("CGP needs functions", {}, usage_error);
    return options;
}

}  // namespace

struct CgpSearch::State {
    State(const rddl_simulator& its_simulator, const CgpOptions& its_options)
        : simulator(its_simulator),
          options(completed(its_options, *simulator.problem)),
          scope(program_scope(simulator, options.lifting, options.time, options.seed)),
          team(std::min(options.threads, options.islands)) {
        for (int i = 0; i < options.islands; ++i)
            islands.push_back(std::make_unique<Island>(simulator, scope, options, i));
        report();
    }

    // Islands do not know of each other between migrations, so who runs them does not matter.
    void run(std::int64_t generations) {
        const auto begin = std::chrono::steady_clock::now();
        while (generations > 0) {
            const std::int64_t until_migration =
                options.migrate_every > 0
                    ? options.migrate_every - progress.generations % options.migrate_every
                    : generations;
            const std::int64_t some = std::min(generations, until_migration);
            std::atomic<std::size_t> next = 0;
            team.run([&](int) {
                for (std::size_t i = next++; i < islands.size(); i = next++)
                    for (std::int64_t g = 0; g < some; ++g) islands[i]->generation();
            });
            generations -= some;
            progress.generations += some;
            if (some == until_migration && islands.size() > 1) migrate();
        }
        progress.seconds +=
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        report();
    }

    // In a ring; all leave before any arrives.
    void migrate() {
        std::vector<std::pair<Genome, Fitness>> best;
        for (const auto& island : islands)
            best.emplace_back(island->record(), island->record_fitness());
        for (std::size_t i = 0; i < islands.size(); ++i) {
            const auto& [genome, fitness] = best[(i + islands.size() - 1) % islands.size()];
            islands[i]->welcome(genome, fitness);
        }
    }

    const Island& best_island() const {
        const Island* best = islands.front().get();
        for (const auto& island : islands)
            if (is_better(island->record_fitness(), best->record_fitness())) best = island.get();
        return *best;
    }

    void report() {
        progress.best = best_island().record_fitness();
        progress.evaluations = progress.episodes = progress.restarts = 0;
        for (const auto& island : islands) {
            progress.evaluations += island->evaluations();
            progress.episodes += island->episodes();
            progress.restarts += island->restarts();
        }
        progress.mean_of_children = islands.front()->mean_of_children();
        progress.replaced = islands.front()->replaced();
    }

    template <class Archive>
    void archive(Archive& archive) {
        archive(progress);
        std::vector<double> scales;
        for (const ProgramInput& input : scope.inputs) {
            scales.push_back(input.shift);
            scales.push_back(input.scale);
        }
        archive(scales);
        if (scales.size() != 2 * scope.inputs.size()) throw Failure("it is of another problem");
        for (std::size_t i = 0; i < scope.inputs.size(); ++i) {
            scope.inputs[i].shift = scales[2 * i];
            scope.inputs[i].scale = scales[2 * i + 1];
        }
        for (const auto& island : islands) island->archive(archive);
    }

    const rddl_simulator& simulator;
    CgpOptions options;
    ProgramScope scope;
    rddl::Team team;
    std::vector<std::unique_ptr<Island>> islands;
    CgpProgress progress;
};

CgpSearch::CgpSearch(const rddl_simulator& simulator, const CgpOptions& options)
    : state_(std::make_unique<State>(simulator, options)) {}
CgpSearch::~CgpSearch() = default;

void CgpSearch::run(std::int64_t generations) {
    state_->run(generations);
}
const ProgramScope& CgpSearch::scope() const {
    return state_->scope;
}
const Genome& CgpSearch::best() const {
    return state_->best_island().record();
}
const CgpProgress& CgpSearch::progress() const {
    return state_->progress;
}

std::string CgpSearch::save() const {
    SavingArchive archive;
    begin_checkpoint(archive, checkpoint, state_->simulator);
    state_->archive(archive);
    return archive.bytes();
}

void CgpSearch::load(std::string_view bytes) {
    LoadingArchive archive(bytes);
    begin_checkpoint(archive, checkpoint, state_->simulator);
    state_->archive(archive);
    state_->report();
}

}  // namespace rddlc::solvers
