#include "solvers/cgp/search.hpp"

#include "solvers/cgp/island.hpp"
#include "solvers/cgp/memory_estimate.hpp"
#include "solvers/cgp/skdecide.hpp"
#include "solvers/files/checkpoint.hpp"
#include "support/failure.hpp"

#include <rddl/batch/threads.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>

namespace rddlc::solvers {

namespace {

const CheckpointKind checkpoint{"CGP", "rddl cgp checkpoint", 5};

// Options that it brings itself may not be given.
void take_skdecide(CgpOptions& options) {
    const CgpOptions none;
    if (options.functions != none.functions || options.constants != none.constants ||
        options.levels_back != none.levels_back || options.lifting == Lifting::On || options.time)
        throw Failure(
            "scikit-decide's programs have their own functions, no constants, and read "
            "neither objects nor the time",
            "leave out --functions, --constants, --levels-back, --lifted and "
            "--time-input, or --compat",
            usage_error);
    options.functions = skdecide_functions();
    options.constants = 0;
    options.mutation = Mutation::Gene;
    options.restart_after = options.tune_every = 0;
    options.parsimony = false;
    if (options.children == 0) options.children = 4;
}

CgpOptions completed(CgpOptions options, const rddl_problem& problem, const Ranks& ranks) {
    if (options.islands == 0) options.islands = ranks.count;
    if (options.islands < ranks.count)
        throw Failure(fmt::format("{} ranks need as many islands, and --islands is {}", ranks.count,
                                  options.islands),
                      {}, usage_error);
    if (options.skdecide) take_skdecide(options);
    if (options.episodes == 0) options.episodes = problem.stochastic ? 16 : 1;
    if (options.children == 0) options.children = problem.stochastic ? 8 : 32;
    if (options.episodes > 1 && options.episodes < 4) options.episodes = 4;
    if (options.functions.empty()) throw Failure("CGP needs functions", {}, usage_error);
    return options;
}

}  // namespace

struct CgpSearch::State {
    State(const rddl_simulator& its_simulator, const CgpOptions& its_options,
          const Ranks& its_ranks)
        : simulator(its_simulator),
          ranks(its_ranks),
          options(completed(its_options, *simulator.problem, ranks)),
          scope(options.skdecide ? skdecide_scope(simulator)
                                 : program_scope(simulator, options.lifting, options.time,
                                                 options.seed, options.stops)),
          share(rddl::share_of(ranks.number, ranks.count, options.islands, 1)),
          team(std::min(options.threads, static_cast<int>(share.end - share.begin))) {
        require_memory(simulator, scope, options, share.end - share.begin);
        for (std::int64_t i = share.begin; i < share.end; ++i)
            islands.push_back(
                std::make_unique<Island>(simulator, scope, options, static_cast<int>(i)));
        report();
    }

    // Islands do not know of each other between migrations, so any rank may run any island.
    void run(std::int64_t generations) {
        const auto begin = std::chrono::steady_clock::now();
        while (generations > 0 && !is_stopped()) {
            const std::int64_t until_migration =
                options.migrate_every > 0
                    ? options.migrate_every - progress.generations % options.migrate_every
                    : generations;
            const std::int64_t some = std::min(generations, until_migration);
            const std::int64_t made = run_islands(some);
            generations -= made;
            progress.generations += made;
            if (made == until_migration && options.islands > 1) migrate();
        }
        progress.seconds +=
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        report();
    }

    // So many generations of each; the fewest that one has made where they stop early.
    std::int64_t run_islands(std::int64_t generations) {
        std::atomic<std::size_t> next = 0;
        std::atomic<std::int64_t> fewest = generations;
        team.run([&](int) {
            for (std::size_t i = next++; i < islands.size(); i = next++) {
                std::int64_t made = 0;
                for (; made < generations && !is_stopped(); ++made) islands[i]->generation();
                for (std::int64_t known = fewest; made < known;)
                    if (fewest.compare_exchange_weak(known, made)) break;
            }
        });
        return fewest;
    }

    bool is_stopped() const { return options.stops && options.stops(); }

    // Migrates in a ring; all programs leave before any arrives.
    void migrate() {
        SavingArchive own;
        for (const auto& island : islands) {
            Found found{island->record(), island->record_fitness()};
            archive_genome(own, found.genome);
            own(found.fitness);
        }
        std::vector<Found> all;
        for (const std::string& theirs : ranks.gather(own.bytes()))
            for (LoadingArchive archive(theirs); !archive.at_end();) {
                Found& found = all.emplace_back();
                archive_genome(archive, found.genome);
                archive(found.fitness);
            }
        for (std::size_t i = 0; i < islands.size(); ++i) {
            const std::size_t number = static_cast<std::size_t>(share.begin) + i;
            islands[i]->welcome(all[(number + all.size() - 1) % all.size()]);
        }
    }

    // This rank's report, in the form that other ranks read.
    std::string own_report() const {
        const Island* first = islands.front().get();
        CgpProgress own;
        Found found{first->record(), first->record_fitness()};
        for (const auto& island : islands) {
            if (is_better(island->record_fitness(), found.fitness))
                found = {island->record(), island->record_fitness()};
            own.evaluations += island->evaluations();
            own.episodes += island->episodes();
            own.restarts += island->restarts();
        }
        own.mean_of_children = first->mean_of_children();
        own.replaced = first->replaced();
        own.best = found.fitness;
        SavingArchive archive;
        archive(own);
        archive_genome(archive, found.genome);
        return archive.bytes();
    }

    void report() {
        progress.evaluations = progress.episodes = progress.restarts = 0;
        bool is_first = true;
        for (const std::string& bytes : ranks.gather(own_report())) {
            LoadingArchive archive(bytes);
            CgpProgress theirs;
            archive(theirs);
            progress.evaluations += theirs.evaluations;
            progress.episodes += theirs.episodes;
            progress.restarts += theirs.restarts;
            if (is_first) {
                progress.mean_of_children = theirs.mean_of_children;
                progress.replaced = theirs.replaced;
            }
            if (is_first || is_better(theirs.best, progress.best)) {
                progress.best = theirs.best;
                archive_genome(archive, best);
            }
            is_first = false;
        }
    }

    template <class Archive>
    void archive(Archive& archive) {
        archive(progress);
        bool skdecide = options.skdecide;
        archive(skdecide);
        if (skdecide != options.skdecide) throw Failure("it is of other programs (--compat)");
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
        archive_islands(archive);
    }

    // One after the other, whatever rank they are on.
    template <class Archive>
    void archive_islands(Archive& archive) {
        int count = options.islands;
        archive(count);
        if (count != options.islands)
            throw Failure(fmt::format("it is of a run of {} islands, and this has {}", count,
                                      options.islands));
        if constexpr (Archive::is_loading) {
            for (std::int64_t i = 0; i < count; ++i) {
                std::string bytes;
                archive(bytes);
                LoadingArchive own(bytes);
                if (i >= share.begin && i < share.end)
                    islands[static_cast<std::size_t>(i - share.begin)]->archive(own);
            }
        } else {
            SavingArchive own;
            for (const auto& island : islands) {
                SavingArchive one;
                island->archive(one);
                own(one.bytes());
            }
            for (const std::string& theirs : ranks.gather(own.bytes())) archive.append(theirs);
        }
    }

    const rddl_simulator& simulator;
    const Fingerprint problem = fingerprint(simulator);
    Ranks ranks;
    CgpOptions options;
    ProgramScope scope;
    rddl::Range share;  // of the islands, that are on this rank
    rddl::Team team;
    std::vector<std::unique_ptr<Island>> islands;
    CgpProgress progress;
    Genome best;
};

CgpSearch::CgpSearch(const rddl_simulator& simulator, const CgpOptions& options, const Ranks& ranks)
    : state_(std::make_unique<State>(simulator, options, ranks)) {}
CgpSearch::~CgpSearch() = default;

void CgpSearch::run(std::int64_t generations) {
    state_->run(generations);
}
const ProgramScope& CgpSearch::scope() const {
    return state_->scope;
}
const Genome& CgpSearch::best() const {
    return state_->best;
}
const CgpProgress& CgpSearch::progress() const {
    return state_->progress;
}

std::int64_t CgpSearch::steps_of_generation() const {
    const CgpOptions& options = state_->options;
    const std::int64_t horizon = state_->simulator.problem->horizon;
    return std::int64_t{options.islands} * options.children * options.episodes *
           std::max<std::int64_t>(horizon, 1);
}

std::string CgpSearch::save() const {
    SavingArchive archive;
    begin_checkpoint(archive, checkpoint, state_->problem);
    state_->archive(archive);
    return archive.bytes();
}

void CgpSearch::load(std::string_view bytes) {
    LoadingArchive archive(bytes);
    begin_checkpoint(archive, checkpoint, state_->problem);
    state_->archive(archive);
    state_->report();
}

}  // namespace rddlc::solvers
