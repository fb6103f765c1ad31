// rddl bench: what a problem costs to compile, how fast it steps, and how fast others step it.
#include "measure/bench.hpp"

#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "formats/table.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"

#include <memory>

namespace rddlc::cli {

namespace {

struct BenchOptions {
    ProblemArguments problem;
    LoadOptions load;
    BenchSettings settings;
    bool json = false;
};

// Warns if episodes fault: the speed of episodes that end at once is of no use.
bool tells_of_faults(const BenchReport& report) {
    if (report.faulted == 0) return false;
    const bool all = report.faulted == report.episodes;
    tell(
        "rddl: {}: {} of {} episodes ended with a fault, and the speeds include them; 'rddl "
        "run' reports the first fault\n",
        all ? "error" : "warning", grouped(report.faulted), grouped(report.episodes));
    return all;
}

// Says where --lanes had no effect.
void note_lanes(const LoadOptions& load, const BenchReport& report) {
    if (load.lanes.value_or(1) == 1 || report.lanes > 1) return;
    tell("rddl: note: --lanes {} has no effect: {} one environment at a time\n", *load.lanes,
         report.engine == Engine::Interpreter ? "the interpreter steps"
                                              : "this problem can only be stepped");
}

ExitStatus bench(const BenchOptions& options) {
    const BenchReport report =
        bench_problem(options.problem.files(), options.load, options.settings);
    options.json ? print_json(report) : print_table(report);
    note_lanes(options.load, report);
    const bool has_failed = tells_of_faults(report);
    if (!is_interrupted()) return has_failed ? diagnosed : success;
    tell("rddl: interrupted before all was measured\n");
    return interrupted_status();
}

void add_peer_options(Command& command, BenchOptions& options) {
    add_list_option(
        command, "--against", "PEER,...",
        "Measure other simulators in the same run: pyrddlgym, jax (pyRDDLGym-jax)",
        [&options](const std::string& name) { options.settings.against.push_back(name); })
        .choices = peer_names();
    add_text_option(command, "--python", "PYTHON",
                    "Python that has them (that of $VIRTUAL_ENV, else python3)",
                    options.settings.python);
}

}  // namespace

Command bench_command() {
    const auto options = std::make_shared<BenchOptions>();
    Command command;
    command.name = "bench";
    command.summary = "Measure compile time, size, memory and steps per second";
    command.details =
        "Examples:\n"
        "  rddl bench domain.rddl instance.rddl\n"
        "  rddl bench SysAdmin_MDP_ippc2011 1 --batch 64,1024,16384 --seconds 3 --json\n"
        "  rddl bench MountainCar_ippc2023 1 --against=pyrddlgym,jax --python venv/bin/python";
    add_problem_arguments(command, options->problem);
    add_number_option(command, "--seconds", "SECONDS", "Time for each measurement (1)",
                      options->settings.seconds, 0.01, 3600.0);
    add_list_option(command, "--batch", "B,...",
                    "Environments in the batches (1024; fewer for large problems)",
                    [options](const std::string& word) {
                        options->settings.batches.push_back(
                            number_of<std::int64_t>("--batch", word, 1, largest_batch));
                    });
    add_number_option(command, "--threads", "T", "Most threads to try (one per core)",
                      options->settings.threads, 1, most_threads);
    add_engine_options(command, options->load);
    add_option(command, "--lanes", "N",
               "Environments in a pack: 8, 16, 32, 64, or 1 (as many as suit the problem)",
               [options](const std::string& count) { options->load.lanes = std::stoi(count); })
        .choices = {"1", "8", "16", "32", "64"};
    add_peer_options(command, *options);
    add_flag(command, "--json", "Print the figures as JSON", options->json);
    command.run = [options] {
        return bench(*options);
    };
    return command;
}

}  // namespace rddlc::cli
