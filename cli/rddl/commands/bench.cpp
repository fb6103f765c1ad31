// rddl bench: what a problem costs to compile, how fast it steps, and how fast others step it.
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "formats/table.hpp"
#include "measure/bench_report.hpp"
#include "solvers/batches/batch.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

namespace rddlc::cli {

namespace {

struct BenchOptions {
    ProblemArguments problem;
    LoadOptions load;
    double seconds = 1;
    std::vector<std::int64_t> batches;  // empty: one of a size that suits the problem
    int threads = 0;
    std::vector<std::string> against;
    std::string python;
    bool json = false;
};

// 1,024 environments, or fewer if their records would not fit into a processor's cache.
std::int64_t suitable_batch(const rddl_problem& problem) {
    constexpr std::int64_t most_bytes = 8 << 20;
    const std::int64_t bytes = problem.state_size + problem.action_size + 1;
    return std::clamp<std::int64_t>(most_bytes / bytes, 16, 1024);
}

// 1, 2, 4, ... and the most that are wanted.
std::vector<int> thread_counts(int wanted) {
    const int most =
        wanted > 0 ? wanted : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    std::vector<int> counts;
    for (int threads = 1; threads < most; threads *= 2) counts.push_back(threads);
    counts.push_back(most);
    return counts;
}

// One environment after the other in one thread, to compare with, and then as fast as it goes.
std::vector<Stepping> steppings(const rddl_simulator& simulator, std::int64_t batch, int threads) {
    const int lanes = batch > 1 ? simulator.lane_count : 1;
    std::vector<Stepping> all;
    if (lanes > 1) all.push_back({1, 1});
    for (const int count : thread_counts(threads)) all.push_back({lanes, count});
    return all;
}

double first_step_seconds(const rddl_simulator& simulator) {
    const auto begin = std::chrono::steady_clock::now();
    const solvers::Batch batch = solvers::create_batch(simulator, course_options(1));
    const rddl_transition nothing{};
    simulator.step(batch.get(), simulator.problem->default_action, &nothing);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void measure_all(const rddl_simulator& simulator, const std::vector<std::int64_t>& batches,
                 const BenchOptions& options, BenchReport& report) {
    const auto course_of = [&](std::int64_t environments) {
        RandomCourse course = draw_course(simulator, environments, options.seconds);
        report.episodes += course.episodes;
        report.faulted += course.faulted;
        return course;
    };
    std::vector<Measurement>& all = report.measurements;
    all.push_back(measure(simulator, course_of(1), Stepping{}, options.seconds));
    for (const std::int64_t batch : batches) {
        if (is_interrupted()) break;
        const RandomCourse course = course_of(batch);
        for (const Stepping& stepping : steppings(simulator, batch, options.threads))
            if (!is_interrupted())
                all.push_back(measure(simulator, course, stepping, options.seconds));
    }
}

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

// pyRDDLGym knows no threads; the others run once with one core and once with all that are wanted.
std::vector<PeerFigures> measure_peers(const ProblemFiles& files, const BenchOptions& options) {
    std::vector<PeerFigures> all;
    for (const std::string& name : options.against) {
        PeerOptions peer{options.python, options.seconds, 1};
        PeerFigures figures = measure_peer(name, files, peer);
        peer.cores = thread_counts(options.threads).back();
        if (knows_threads(name) && peer.cores > 1) {
            const PeerFigures more = measure_peer(name, files, peer);
            figures.measurements.insert(figures.measurements.end(), more.measurements.begin(),
                                        more.measurements.end());
        }
        all.push_back(std::move(figures));
    }
    return all;
}

ExitStatus bench(const BenchOptions& options) {
    const ProblemFiles files = options.problem.files();
    LoadOptions load = options.load;
    load.ignore_cache |= !options.against.empty();  // the others also compile again
    const LoadedProblem problem = load_problem(files, load);
    const rddl_simulator& simulator = *problem.simulator;

    BenchReport report;
    report.problem = files.name;
    report.engine = load.engine;
    report.real = load.real;
    report.lanes = simulator.lane_count;
    report.instruction_set = simulator.instruction_set;
    report.costs = problem.costs;
    const double first_step = problem.costs.load_seconds + first_step_seconds(simulator);
    if (load.engine == Engine::Interpreter || problem.costs.build_seconds)
        report.first_step_seconds = first_step;
    report.peers = measure_peers(files, options);

    std::vector<std::int64_t> batches = options.batches;
    if (batches.empty()) batches.push_back(suitable_batch(*simulator.problem));
    const std::int64_t largest = *std::max_element(batches.begin(), batches.end());
    solvers::require_room(simulator, largest, files.memory_limit);
    report.memory_per_environment = memory_per_environment(simulator, largest);
    measure_all(simulator, batches, options, report);
    options.json ? print_json(report) : print_table(report);
    const bool has_failed = tells_of_faults(report);
    if (!is_interrupted()) return has_failed ? diagnosed : success;
    tell("rddl: interrupted before all was measured\n");
    return interrupted_status();
}

void add_peer_options(Command& command, BenchOptions& options) {
    add_list_option(command, "--against", "PEER,...",
                    "Measure other simulators in the same run: pyrddlgym, jax (pyRDDLGym-jax)",
                    [&options](const std::string& name) { options.against.push_back(name); })
        .choices = peer_names();
    add_text_option(command, "--python", "PYTHON",
                    "Python that has them (that of $VIRTUAL_ENV, else python3)", options.python);
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
                      options->seconds, 0.01, 3600.0);
    add_list_option(
        command, "--batch", "B,...", "Environments in the batches (1024; fewer for large problems)",
        [options](const std::string& word) {
            options->batches.push_back(number_of<std::int64_t>("--batch", word, 1, largest_batch));
        });
    add_number_option(command, "--threads", "T", "Most threads to try (one per core)",
                      options->threads, 1, most_threads);
    add_engine_options(command, options->load);
    add_peer_options(command, *options);
    add_flag(command, "--json", "Print the figures as JSON", options->json);
    command.run = [options] {
        return bench(*options);
    };
    return command;
}

}  // namespace rddlc::cli
