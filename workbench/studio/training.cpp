#include "studio/training.hpp"

#include "formats/records_json.hpp"
#include "solvers/cgp/option_table.hpp"
#include "solvers/cgp/trainee.hpp"
#include "solvers/ppo/option_table.hpp"
#include "solvers/ppo/trainee.hpp"
#include "solvers/spaces/refusals.hpp"
#include "support/failure.hpp"
#include "support/files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <utility>

namespace rddlc::studio {

using namespace workbench;

namespace {

// Sets the options of a learner from words as "lr=0.001" or "--lr=0.001".
template <class Options>
Options options_of(const solvers::OptionTable<Options>& table,
                   const std::vector<std::string>& words) {
    Options options;
    for (const std::string& word : words) {
        const std::size_t sign = word.find('=');
        const std::string given = word.substr(0, sign);
        const std::string name = given.starts_with("--") ? given : "--" + given;
        const auto option = std::ranges::find(table, name, &solvers::OptionText::name);
        if (option == table.end())
            throw Failure(solvers::unknown_option(name, {table.begin(), table.end()},
                                                  solvers::Face::CommandLine));
        const std::string value = sign == std::string::npos ? "on" : word.substr(sign + 1);
        try {
            option->set(options,
                        option->is_list ? solvers::words_of_list(value) : std::vector{value});
        } catch (const solvers::OptionRefused& refused) {
            throw Failure(fmt::format("{}: {}", name, refused.what()));
        }
    }
    return options;
}

solvers::Trainee trainee_of(const rddl_simulator& simulator, const TrainingRequest& request,
                            std::int64_t memory_limit, const std::function<bool()>& stops) {
    const auto completed = [&](auto options) {
        options.seed = request.seed;
        options.memory_limit = memory_limit;
        options.stops = stops;
        return options;
    };
    if (request.solver == "cgp")
        return solvers::cgp_trainee(
            simulator, completed(options_of(solvers::cgp_option_table(), request.options)));
    solvers::require_an_end_to_learn(*simulator.problem);
    solvers::PpoOptions ppo = completed(options_of(solvers::ppo_option_table(), request.options));
    ppo.shortens_rollout = !ppo.names_rollout;
    return solvers::ppo_trainee(simulator, ppo);
}

// The points of the curve, which are thinned where they become too many to be drawn.
class LearningCurve {
  public:
    explicit LearningCurve(std::string folder) : folder_(std::move(folder)) {}

    void add(std::int64_t steps, double seconds, const solvers::Row& row) {
        // The return of PPO's last episodes, and that of CGP's best program.
        const double learning = number_of(row, {"rollout/ep_rew_mean", "search/best"});
        points_.push_back(
            {static_cast<double>(steps), seconds, learning, number_of(row, {"eval/mean_reward"})});
        if (points_.size() <= most) return;
        std::size_t kept = 0;
        for (std::size_t i = 0; i < points_.size(); i += 2) points_[kept++] = points_[i];
        points_.resize(kept);
    }

    Json json() const {
        Json all{{"folder", folder_}};
        const char* const names[] = {"steps", "seconds", "learning", "evaluation"};
        for (std::size_t c = 0; c < std::size(names); ++c) {
            Json& column = all[names[c]] = Json::array();
            for (const Point& point : points_)
                column.push_back(std::isfinite(point[c]) ? Json(point[c]) : Json(nullptr));
        }
        return all;
    }

  private:
    using Point = std::array<double, 4>;
    static constexpr std::size_t most = 600;

    static double number_of(const solvers::Row& row, std::initializer_list<const char*> names) {
        for (const auto& [name, value] : row)
            if (std::ranges::find(names, name) != names.end()) return value;
        return std::nan("");
    }

    std::string folder_;
    std::vector<Point> points_;
};

}  // namespace

std::filesystem::path new_run_folder(const std::string& instance, const std::string& solver,
                                     std::uint64_t seed) {
    const std::string name = fmt::format("{}_{}_{}", instance, solver, seed);
    std::filesystem::path folder = std::filesystem::path("runs") / name;
    for (int number = 2; is_there(folder); ++number)
        folder = std::filesystem::path("runs") / fmt::format("{}-{}", name, number);
    return folder;
}

void require_options(const TrainingRequest& request) {
    if (request.solver == "cgp")
        options_of(solvers::cgp_option_table(), request.options);
    else if (request.solver == "ppo")
        options_of(solvers::ppo_option_table(), request.options);
    else
        throw Failure(fmt::format("there is no learner '{}'", request.solver), "ppo or cgp");
}

Json train(Job& job, const LoadedProblem& problem, const TrainingRequest& request) {
    const rddl_simulator& simulator = *problem.simulator;
    const std::function<bool()> stops = [&job] {
        return job.stops();
    };
    const solvers::Trainee trainee =
        trainee_of(simulator, request, problem.files.memory_limit, stops);
    solvers::TrainingOptions options;
    options.folder = request.folder;
    options.seconds = request.seconds;
    options.seed = request.seed;
    options.settings = request.settings;
    options.memory_limit = problem.files.memory_limit;
    options.quiet = true;
    options.stops = stops;
    LearningCurve curve(request.folder.string());
    job.report(curve.json());
    options.see_row = [&](std::int64_t steps, double seconds, const solvers::Row& row) {
        curve.add(steps, seconds, row);
        job.report(curve.json());
    };
    const solvers::TrainingResult result = solvers::train(simulator, trainee, options);
    Json outcome{{"folder", request.folder.string()},
                 {"has_policy", result.has_best},
                 {"best_return", json_number(result.best_return)},
                 {"note", trainee.note},
                 {"warning", result.no_better}};
    if (result.has_best && trainee.summary)
        outcome["summary"] = trainee.summary(result.best_policy);
    return outcome;
}

}  // namespace rddlc::studio
