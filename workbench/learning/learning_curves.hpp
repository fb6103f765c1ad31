// The logs of runs, as curves.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::workbench {

// The rows of progress.csv in a run's folder. Numbers that are absent are nan.
struct RunProgress {
    std::filesystem::path folder;
    std::vector<std::string> columns;
    std::vector<std::vector<double>> values;  // column by column
};
// Throws a Failure that names file and line.
RunProgress read_progress(const std::filesystem::path& folder);

// The numbers of a column. Throws a Failure that names those there are.
const std::vector<double>& column_of(const RunProgress& run, const std::string& name);

// The folders of runs that a path means: itself, or those in it, by their names. Throws a Failure
// if there are no runs.
std::vector<std::filesystem::path> run_folders(const std::filesystem::path& path);

// A curve of one run, or of several that differ in their seeds: mean and standard deviation.
struct Curve {
    std::string name;
    int runs = 1;
    std::vector<double> x, mean, deviation;
};

// One curve of the runs by `x` and `y`, which are names of columns. Several runs are read at the
// same places; one that ended before others keeps its last value. Throws a Failure if a run has no
// such column, or no number in it.
Curve curve_of(const std::string& name, const std::vector<RunProgress>& runs, const std::string& x,
               const std::string& y);

// "runs/car_ppo_3" is one of the runs "runs/car_ppo" if its seed is 3; any other number is part of
// the name.
std::string without_seed(const std::string& name, std::uint64_t seed);

// "ppo", "cgp" or "drp", as run.json in the folder says; "" without that file. Throws a Failure if
// it says anything else.
std::string solver_of_run(const std::filesystem::path& folder);

struct RunDescription {
    std::string what;  // "ppo mountain_car inst_1": solver, domain and instance
    std::uint64_t seed = 0;
};
// The description of the run in the folder, from its run.json, if there is one. Throws a Failure
// that names the file if that makes no sense.
std::optional<RunDescription> description_of(const std::filesystem::path& folder);

}  // namespace rddlc::workbench
