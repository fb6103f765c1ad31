// rddl bench: how many steps a second, for one environment and for batches.
#include "batch.hpp"
#include "commands.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "random_policy.hpp"
#include "statistics.hpp"
#include "table.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <thread>

namespace rddlc::cli {

namespace {

struct BenchOptions {
    ProblemArguments problem;
    LoadOptions load;
    double seconds = 1;
    std::int64_t batch = 1024;
    int threads = 0;
    bool json = false;
};

struct Measurement {
    std::int64_t environments = 0;
    int threads = 0;
    std::int64_t steps = 0;  // of all environments
    double seconds = 0;

    double steps_per_second() const { return static_cast<double>(steps) / seconds; }
};

// Random actions drawn beforehand, so that only stepping is measured: `sets` records for each
// environment, used in turn.
class PreparedActions {
  public:
    PreparedActions(const rddl_problem& problem, std::int64_t environments)
        : set_size_(static_cast<std::size_t>(environments * problem.action_size)),
          actions_(sets * set_size_) {
        RandomPolicy policy(problem, 0);
        for (std::size_t set = 0; set < sets; ++set)
            for (std::int64_t i = 0; i < environments; ++i)
                policy.act(i, static_cast<std::int64_t>(set),
                           actions_.data() + set * set_size_ + i * problem.action_size);
    }
    const std::byte* next() { return actions_.data() + (turn_++ % sets) * set_size_; }

  private:
    static constexpr std::size_t sets = 8;

    std::size_t set_size_;
    std::vector<std::byte> actions_;
    std::size_t turn_ = 0;
};

// Steps, with resets where episodes end, until the time is over.
Measurement measure(const rddl_simulator& simulator, std::int64_t environments, int threads,
                    double seconds) {
    using Clock = std::chrono::steady_clock;
    const Batch batch =
        create_batch(simulator, {environments, 0, 0, threads, RDDL_AUTORESET_SAME_STEP, -1});
    PreparedActions actions(*simulator.problem, environments);
    std::vector<double> rewards(static_cast<std::size_t>(environments));
    std::vector<std::uint8_t> terminated(rewards.size()), truncated(rewards.size());
    const rddl_transition out{nullptr,          rewards.data(), terminated.data(),
                              truncated.data(), nullptr,        nullptr};
    const auto step = [&] {
        simulator.step(batch.get(), actions.next(), &out);
    };

    step();  // warms caches and threads
    Measurement result{environments, threads, 0, 0};
    const auto begin = Clock::now();
    std::int64_t calls = 1;  // between looks at the clock: enough for the looks not to count
    do {
        const auto lap = Clock::now();
        for (std::int64_t i = 0; i < calls; ++i) step();
        result.steps += calls * environments;
        const auto now = Clock::now();
        result.seconds = std::chrono::duration<double>(now - begin).count();
        if (now - lap < std::chrono::milliseconds(5)) calls *= 2;
    } while (result.seconds < seconds && !is_interrupted());
    return result;
}

std::vector<Measurement> measure_all(const rddl_simulator& simulator, const BenchOptions& options) {
    const int most = options.threads > 0
                         ? options.threads
                         : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    std::vector<Measurement> all{measure(simulator, 1, 1, options.seconds)};
    for (int threads = 1; threads <= most && !is_interrupted(); threads *= 2) {
        all.push_back(measure(simulator, options.batch, threads, options.seconds));
        if (threads < most && threads * 2 > most && !is_interrupted())
            all.push_back(measure(simulator, options.batch, most, options.seconds));
    }
    return all;
}

void print_table(const rddl_problem& problem, const BenchOptions& options,
                 const std::vector<Measurement>& all) {
    fmt::print("{} ({}), {}: random actions drawn beforehand, resets included\n\n",
               problem.instance, problem.domain, name_of(options.load.engine));
    Table table({{"environments", Align::Right},
                 {"threads", Align::Right},
                 {"steps/s", Align::Right},
                 {"one step", Align::Right},
                 {"speed-up", Align::Right}});
    for (const Measurement& m : all)
        table.add_row({grouped(m.environments), std::to_string(m.threads),
                       rate_text(m.steps_per_second()), seconds_text(1 / m.steps_per_second()),
                       fmt::format("{:.2f}", m.steps_per_second() / all[0].steps_per_second())});
    fmt::print("{}", table.text());
}

void print_json(const LoadedProblem& problem, const BenchOptions& options,
                const std::vector<Measurement>& all) {
    nlohmann::ordered_json measurements = nlohmann::ordered_json::array();
    for (const Measurement& m : all)
        measurements.push_back({{"environments", m.environments},
                                {"threads", m.threads},
                                {"steps", m.steps},
                                {"seconds", m.seconds},
                                {"steps_per_second", m.steps_per_second()}});
    const nlohmann::ordered_json out{{"problem", problem.files.name},
                                     {"engine", name_of(options.load.engine)},
                                     {"measurements", measurements}};
    fmt::print("{}\n", out.dump(2));
}

ExitStatus bench(const BenchOptions& options) {
    const LoadedProblem problem = load_problem(options.problem.files(), options.load);
    const std::vector<Measurement> all = measure_all(*problem.simulator, options);
    if (options.json)
        print_json(problem, options, all);
    else
        print_table(*problem.simulator->problem, options, all);
    return is_interrupted() ? interrupted : success;
}

}  // namespace

Command add_bench_command(CLI::App& program) {
    CLI::App* const app = program.add_subcommand("bench", "Measure steps per second");
    app->footer(
        "Examples:\n"
        "  rddl bench domain.rddl instance.rddl\n"
        "  rddl bench SysAdmin_MDP_ippc2011 1 --batch 4096 --seconds 3 --json");
    const auto options = std::make_shared<BenchOptions>();
    add_problem_arguments(*app, options->problem);
    app->add_option("--seconds", options->seconds, "Time for each measurement (1)")
        ->check(CLI::Range(0.01, 3600.0).description(""))
        ->type_name("SECONDS");
    app->add_option("--batch", options->batch, "Environments in the batches (1024)")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 24).description(""))
        ->type_name("B");
    app->add_option("--threads", options->threads, "Most threads to try (one per core)")
        ->check(CLI::Range(1, 4096).description(""))
        ->type_name("T");
    add_engine_options(*app, options->load);
    app->add_flag("--json", options->json, "Print the measurements as JSON");
    return {app, [options] {
                return bench(*options);
            }};
}

}  // namespace rddlc::cli
