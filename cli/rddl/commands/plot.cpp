// rddl plot: learning curves of runs.
#include "commands/commands.hpp"
#include "learning/run_groups.hpp"
#include "pictures/charts.hpp"
#include "support/program.hpp"

#include <fmt/format.h>

#include <memory>

namespace rddlc::cli {

namespace {

struct PlotOptions {
    std::vector<std::string> runs;
    std::string x = "auto", y = "eval/mean_reward";
    bool each = false;
    ChartFiles files;
};

ExitStatus plot(const PlotOptions& options) {
    ChartFiles files = options.files;
    if (!files.any()) files.png = "curves.png";
    require_writable_chart(files);
    const std::vector<RunGroup> groups = run_groups(options.runs, options.each);
    const std::string steps = steps_title(groups);
    const bool by_time = options.x == "time" || (options.x == "auto" && steps.empty());
    const bool by_steps = options.x == "steps" || (options.x == "auto" && !steps.empty());
    const std::string x = by_time    ? "time/time_elapsed"
                          : by_steps ? "time/total_timesteps"
                                     : options.x;
    CurveChart chart{options.y,
                     by_time    ? "seconds"
                     : by_steps ? (steps.empty() ? "steps" : steps)
                                : options.x,
                     options.y,
                     {}};
    chart.title = fmt::format("{} by {}", options.y, chart.x_title);
    for (const RunGroup& group : groups)
        chart.curves.push_back(curve_of(group.name, group.runs, x, options.y));
    write_chart(chart, files);
    for (const std::string& file : {files.png, files.svg})
        if (!file.empty()) print("wrote {}\n", file);
    return success;
}

}  // namespace

Command plot_command() {
    const auto options = std::make_shared<PlotOptions>();
    Command command;
    command.name = "plot";
    command.summary = "Draw the learning curves of runs";
    command.details =
        "Runs of 'rddl train' whose names differ only in the seed at their end (NAME_SEED) are "
        "one\n"
        "curve, as are all runs of a solver on a problem in a folder: their mean, and a band of "
        "the\nstandard deviation around it.\n\n"
        "Examples:\n"
        "  rddl plot runs/car_ppo_0 runs/car_ppo_1 runs/car_cgp_0 --png curves.png\n"
        "  rddl plot runs/a --y train/approx_kl --svg kl.svg";
    add_argument(command, "RUNS", "Folders of runs, or folders that hold them",
                 [options](const std::string& run) {
                     std::string name = run;
                     while (name.size() > 1 && name.back() == '/') name.pop_back();
                     options->runs.push_back(name);
                 });
    command.options.back().is_required = true;
    command.options.back().is_list = true;
    add_text_option(command, "--y", "COLUMN", "Column of progress.csv (eval/mean_reward)",
                    options->y)
        .suggestions = {"eval/mean_reward",    "eval/mean_ep_length", "rollout/ep_rew_mean",
                        "rollout/ep_len_mean", "train/approx_kl",     "train/value_loss",
                        "search/best"};
    add_text_option(command, "--x", "WHAT",
                    "steps (of PPO; generations of CGP), time in seconds, or a column; auto "
                    "(default): time where solvers differ",
                    options->x)
        .suggestions = {"auto", "steps", "time"};
    add_flag(command, "--each", "A curve for each run", options->each);
    add_chart_options(command, options->files);
    command.run = [options] {
        return plot(*options);
    };
    return command;
}

}  // namespace rddlc::cli
