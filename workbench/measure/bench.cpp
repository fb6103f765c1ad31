#include "measure/bench.hpp"

#include "solvers/batches/batch.hpp"
#include "terminal/interrupt.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace rddlc::workbench {

namespace {

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
    const solvers::BatchHandle batch = solvers::create_batch(simulator, course_options(1));
    const rddl_transition nothing{};
    simulator.step(batch.get(), simulator.problem->default_action, &nothing);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void measure_all(const rddl_simulator& simulator, const std::vector<std::int64_t>& batches,
                 const BenchSettings& options, BenchReport& report) {
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

// pyRDDLGym knows no threads; the others run once with one core and once with all that are wanted.
std::vector<PeerFigures> measure_peers(const ProblemFiles& files, const BenchSettings& options) {
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

}  // namespace

BenchReport bench_problem(const ProblemFiles& files, LoadOptions load,
                          const BenchSettings& options) {
    load.ignore_cache |= !options.against.empty();  // the others also compile again
    if (load.engine == Engine::Auto) load.engine = Engine::Compiled;  // one engine is measured
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
    solvers::require_memory(simulator, largest, files.memory_limit);
    report.memory_per_environment = memory_per_environment(simulator, largest);
    measure_all(simulator, batches, options, report);
    return report;
}

}  // namespace rddlc::workbench
