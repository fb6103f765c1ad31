#include "commands/options.hpp"

#include "driver/driver.hpp"
#include "learning/learned_policy.hpp"
#include "solvers/spaces/refusals.hpp"
#include "support/suggestion.hpp"

#include <fmt/format.h>

namespace rddlc::cli {

ProblemFiles ProblemArguments::files() const {
    return with_options(find_files(first, second));
}

ProblemFiles ProblemArguments::with_options(ProblemFiles files) const {
    files.instance_name = instance_name;
    files.standard = standard;
    files.memory_limit = memory_limit;
    return files;
}

void add_problem_arguments(Command& command, ProblemArguments& arguments, bool required) {
    add_argument(
        command, "DOMAIN",
        "Domain file, or one that also holds the instance; folder of a domain.rddl and its "
        "instances; or NAME of a problem of rddlrepository",
        arguments.first)
        .is_required = required;
    add_argument(command, "INSTANCE", "Instance file, or number of the instance", arguments.second);
    add_text_option(command, "--instance", "NAME",
                    "Use the instance of this name, if the files hold several",
                    arguments.instance_name);
    add_standard_option(command, arguments.standard);
    add_option(
        command, "--memory-limit", "SIZE",
        "Bytes that simulators and learners may take: 4G (default), 512M, 1e9, ...",
        [&arguments](const std::string& bytes) { arguments.memory_limit = std::stoll(bytes); })
        .kind = OptionKind::Bytes;
}

void require_an_end(const rddl_problem& problem, std::int64_t horizon) {
    if (solvers::is_endless(problem, horizon))
        throw Failure(solvers::endless, "give one with --horizon", usage_error);
}

void add_standard_option(Command& command, Standard& standard) {
    add_option(command, "--std", "STANDARD",
               "RDDL as pyrddlgym accepts it (default), or rddlc: with extensions",
               [&standard](const std::string& name) { standard = *standard_named(name); })
        .choices = {"pyrddlgym", "rddlc"};
}

void add_extern_option(Command& command, LoadOptions& options, const std::string& explanation) {
    add_repeated_option(command, "--extern", "FILE", explanation, options.externs);
}

void add_pass_options(Command& command, LoadOptions& options) {
    add_list_option(command, "--without", "PASS,...",
                    "Leave out optimisations; 'rddlc --help' lists them",
                    [&options](const std::string& name) {
                        if (const auto complaint = complaint_about_pass(name))
                            throw UsageError(*complaint);
                        options.passes.without.insert(name);
                    })
        .suggestions = pass_names();
    add_flag(command, "--fast-math",
             "Compute with reals as if they were not rounded, and never inf or nan",
             options.passes.fast_math);
}

void add_cache_option(Command& command, LoadOptions& options) {
    add_flag(command, "--no-cache", "Compile again instead of using a cached simulator",
             options.ignore_cache);
}

void add_engine_options(Command& command, LoadOptions& options) {
    add_option(command, "--engine", "ENGINE",
               "Engine: auto (default) starts with the interpreter and changes to the compiled "
               "engine when "
               "that is ready; compiled waits for it; interpreter needs no C++ compiler",
               [&options](const std::string& name) { options.engine = *engine_named(name); })
        .choices = {"auto", "compiled", "interpreter"};
    add_extern_option(command, options,
                      "C++ header of the external functions; the interpreter also takes a .so");
    add_pass_options(command, options);
    add_option(command, "--real", "TYPE",
               "Type of reals in computations: double (default) or float",
               [&options](const std::string& name) {
                   options.real = name == "float" ? RealType::Float : RealType::Double;
               })
        .choices = {"double", "float"};
    add_cache_option(command, options);
}

namespace {

constexpr std::array policies_of_one_word = {Policy::Random, Policy::Noop, Policy::Rddl};

std::vector<std::string> names_of_policies() {
    std::vector<std::string> names;
    for (const Policy each : policies_of_one_word) names.emplace_back(name_of(each));
    return names;
}

void choose_policy(const std::string& name, Policy& policy,
                   std::optional<std::filesystem::path>& file, RolloutOptions* rollouts) {
    for (const Policy each : policies_of_one_word) {
        if (name_of(each) != name) continue;
        policy = each;
        file.reset();
        return;
    }
    if (planners::is_planner(name) && rollouts) {
        planners::require_planner(name);
        policy = Policy::Planner;
        rollouts->planner = name;
        return;
    }
    if (!is_path(name))
        throw UsageError(fmt::format("--policy: '{}' is neither random, noop, rddl nor a file{}",
                                     name,
                                     ending_with_name(did_you_mean(name, names_of_policies()))));
    if (is_learned_policy(name)) {
        if (!rollouts)
            throw UsageError(
                fmt::format("--policy: '{}' is a trace or a learned policy, which this "
                            "command does not accept; --states takes the states of a trace",
                            name));
        policy = Policy::Learned;
        rollouts->learned = name;
        return;
    }
    policy = Policy::Rddl;
    file = name;
}

}  // namespace

void add_planner_options(Command& command, PlannerSettings& planning) {
    add_flag(command, "--cheat", "Let planners see the state of problems that are observed in part",
             planning.cheat);
    add_text_option(command, "--explain-decisions", "FILE",
                    "Write what planners' decisions were made by, a line of JSON each; - is "
                    "stdout, without a summary",
                    planning.explanations);
}

void add_policy_option(Command& command, Policy& policy, std::optional<std::filesystem::path>& file,
                       RolloutOptions* rollouts) {
    add_option(
        command, "--policy", "POLICY",
        std::string(
            "Policy: random (default): legal random actions; noop: default actions; rddl: the "
            "policy block of the problem; FILE: the policy block in it") +
            (rollouts
                 ? ", a learned policy, or the actions of a trace (.jsonl): episode 0 "
                   "plays those of its episode 0 and so on, and after its last episode comes "
                   "its first one again; plan:NAME: a planner ('rddl help evaluate' lists them)"
                 : ""),
        [&policy, &file, rollouts](const std::string& name) {
            choose_policy(name, policy, file, rollouts);
        })
        .suggestions = {"random", "noop", "rddl"};
}

namespace {

// "600x400"
void read_size(const std::string& text, int& width, int& height) {
    const std::size_t by = text.find_first_of("xX");
    if (by == std::string::npos)
        throw UsageError(fmt::format("--size: '{}' is not WIDTHxHEIGHT, such as 600x400", text));
    width = number_of<int>("--size", text.substr(0, by), 16, 8192);
    height = number_of<int>("--size", text.substr(by + 1), 16, 8192);
}

}  // namespace

void add_size_option(Command& command, int& width, int& height, const std::string& explanation) {
    add_option(command, "--size", "WxH", explanation,
               [&width, &height](const std::string& text) { read_size(text, width, height); });
}

void add_chart_options(Command& command, ChartFiles& files) {
    add_text_option(command, "--png", "FILE", "Write a picture", files.png);
    add_text_option(command, "--svg", "FILE", "Write a vector graphic", files.svg);
    add_size_option(command, files.width, files.height, "Pixels of the picture (900x600)");
}

void add_picture_options(Command& command, PictureOptions& options) {
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    add_text_option(command, "--gif", "FILE",
                    "Write a movie of an episode; - is stdout, here and below", options.gif);
    add_text_option(command, "--video,--mp4", "FILE",
                    "Write the movie as .mp4, .webm or .webp, by the program ffmpeg",
                    options.video);
    add_text_option(command, "--png", "PATH",
                    "Write a picture of one state, FILE.png or -; another path: a folder of all",
                    options.png);
    add_text_option(command, "--svg", "PATH", "Write vector graphics, as --png does pictures",
                    options.svg);
    add_text_option(command, "--html", "FILE", "Write a page that replays the episode, in one file",
                    options.html);
    add_flag(command, "--watch", "Show the episode in the terminal, state by state", options.watch);
    add_text_option(command, "--visualizer", "NAME",
                    "Drawing of states: auto, chart, heatmap, text, or that of a domain (the "
                    "one for the problem's domain); 'list' prints all",
                    options.visualizer);
    add_text_option(command, "--scene", "FILE.json",
                    "Draw the shapes that this file describes (docs/scenes.md)", options.scene);
    add_size_option(command, options.width, options.height, "Pixels of a picture (600x400)");
    add_number_option<double>(command, "--fps", "N", "Steps a second in movies (10)",
                              options.frames_per_second, 0.01, 1000);
    add_number_option<double>(command, "--real-time-factor", "X",
                              "Show X seconds of the problem in a second of the movie, where a "
                              "non-fluent gives the length of a step",
                              options.real_time_factor, 1e-6, 1e6);
    add_number_option<std::int64_t>(command, "--max-frames", "N",
                                    "Largest number of pictures: every second, third, ... state of "
                                    "a longer episode (1000)",
                                    options.most_frames, 1, most);
    add_number_option<std::int64_t>(command, "--environment", "K",
                                    "Number of the episode, from 0 on (0; --watch shows all)",
                                    options.episode, 0, most);
    add_number_option<std::int64_t>(command, "--step", "K",
                                    "State that a single picture shows (the last one)",
                                    options.step, 0, most);
}

void add_preconditions_option(Command& command, Preconditions& preconditions) {
    add_option(command, "--preconditions", "WHAT",
               "Illegal actions: ignore (default) and warn take them, error refuses, noop does "
               "nothing",
               [&preconditions](const std::string& name) {
                   preconditions = name == "warn"    ? Preconditions::Warn
                                   : name == "error" ? Preconditions::Error
                                   : name == "noop"  ? Preconditions::Noop
                                                     : Preconditions::Ignore;
               })
        .choices = {"ignore", "warn", "error", "noop"};
}

}  // namespace rddlc::cli
