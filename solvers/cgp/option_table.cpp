#include "solvers/cgp/option_table.hpp"

#include "solvers/cgp/functions.hpp"
#include "solvers/evaluation/threads.hpp"

namespace rddlc::solvers {

namespace {

using O = CgpOptions;
using Option = LearnerOption<O>;

constexpr std::int64_t most_generations = std::int64_t{1} << 40;

Option functions_option() {
    Option option{{"--functions",
                   "functions",
                   "NAME,...",
                   "Functions, or groups of them: arith, trig, logic (default: these), round, unit",
                   {"function_set"},
                   true,
                   true},
                  {},
                  {}};
    option.set = [](O& o, const std::vector<std::string>& words) {
        std::vector<Function> functions = functions_named(words);
        if (functions.empty()) throw OptionRefused("a program has one function or more");
        o.functions = std::move(functions);
    };
    option.text = [](const O& o) {
        std::string names;
        for (const Function function : o.functions)
            names += (names.empty() ? "" : ",") + std::string(info_of(function).name);
        return names;
    };
    return option;
}

template <class Member>
Option int_option(OptionText text, Member member, int least, int most) {
    return number_option<O, int>(std::move(text), member, least, most);
}
template <class Member>
Option generations_option(OptionText text, Member member, std::int64_t least) {
    return number_option<O, std::int64_t>(std::move(text), member, least, most_generations);
}

OptionTable<O> make_table() {
    return {
        generations_option(
            {"--gens", "generations", "N", "Generations (1000)", {"n_generations"}, false},
            [](auto& o) -> auto& { return o.generations; }, 1),
        int_option(
            {"--lambda",
             "children",
             "N",
             "Children (32, or 8 if anything is drawn at random; 4 with --compat)",
             {"lambda_", "population_size", "n_offspring"}},
            [](auto& o) -> auto& { return o.children; }, 1, 1 << 16),
        int_option(
            {"--cols", "nodes", "N", "Nodes (100)", {"columns", "n_columns"}},
            [](auto& o) -> auto& { return o.nodes; }, 1, 1 << 20),
        int_option(
            {"--constants", "constants", "N", "Constants (4)"},
            [](auto& o) -> auto& { return o.constants; }, 0, 1 << 10),
        int_option(
            {"--levels-back", "levels_back", "N",
             "Nodes back from which a node reads; 0 (default): all"},
            [](auto& o) -> auto& { return o.levels_back; }, 0, 1 << 20),
        choice_option<O, Mutation>(
            {"--mutation", "mutation", "HOW",
             "Mutation: single (default): until one gene that counts is another; gene: each with a "
             "probability"},
            [](auto& o) -> auto& { return o.mutation; },
            {{"single", Mutation::Single}, {"gene", Mutation::Gene}}),
        functions_option(),
        int_option(
            {"--episodes", "episodes", "N",
             "Episodes of each program (1, or 16 if anything is drawn at random)"},
            [](auto& o) -> auto& { return o.episodes; }, 1, 1 << 20),
        choice_option<O, Measure>(
            {"--fitness", "measure", "WHAT",
             "Statistic of the returns: mean (default), median, min, or cvar: the "
             "mean of the worst fifth"},
            [](auto& o) -> auto& { return o.measure; },
            {{"mean", Measure::Mean},
             {"median", Measure::Median},
             {"min", Measure::Minimum},
             {"cvar", Measure::WorstFifth}}),
        generations_option(
            {"--restart", "restart_after", "N",
             "Restart after so many generations without progress (300); 0: never"},
            [](auto& o) -> auto& { return o.restart_after; }, 0),
        generations_option(
            {"--tune", "tune_every", "N",
             "Generations between searches for better constants (50); 0: never"},
            [](auto& o) -> auto& { return o.tune_every; }, 0),
        choice_option<O, Lifting>(
            {"--lifted", "lifted", "WHEN",
             "One program for all objects: auto (default: where an action has "
             "objects), on, off"},
            [](auto& o) -> auto& { return o.lifting; },
            {{"auto", Lifting::Auto}, {"on", Lifting::On}, {"off", Lifting::Off}}),
        switch_option<O>(
            {"--parsimony", "parsimony", "WHEN",
             "Prefer the smaller of equally good programs: on "
             "(default), off"},
            [](auto& o) -> auto& { return o.parsimony; }),
        switch_option<O>(
            {"--time-input", "time", "", "Let programs read the elapsed part of the episode"},
            [](auto& o) -> auto& { return o.time; }),
        choice_option<O, bool>(
            {"--compat", "compat", "WHOSE",
             "Compatibility: skdecide: search for programs in scikit-decide's form, with its "
             "functions and its mutation; none (default)"},
            [](auto& o) -> auto& { return o.skdecide; }, {{"none", false}, {"skdecide", true}}),
        int_option(
            {"--islands", "islands", "N", "Populations (1, or one on each rank of MPI)", {}, false},
            [](auto& o) -> auto& { return o.islands; }, 1, 1 << 12),
        generations_option(
            {"--migrate",
             "migrate_every",
             "N",
             "Generations between migrations (50); 0: none",
             {"migration"}},
            [](auto& o) -> auto& { return o.migrate_every; }, 0),
        int_option(
            {"--threads",
             "threads",
             "T",
             "Threads, at most one for each island (1)",
             {"n_jobs", "num_threads"},
             false},
            [](auto& o) -> auto& { return o.threads; }, 1, most_threads)};
}

}  // namespace

const OptionTable<CgpOptions>& cgp_option_table() {
    static const OptionTable<CgpOptions> table = make_table();
    return table;
}

}  // namespace rddlc::solvers
