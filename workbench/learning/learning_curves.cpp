#include "learning/learning_curves.hpp"

#include "support/failure.hpp"
#include "support/files.hpp"
#include "support/json_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace rddlc::workbench {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t places = 400;  // at which several runs are read

std::vector<std::string_view> parts_of(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (;;) {
        const std::size_t end = text.find(separator);
        parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

double number_in(std::string_view word, const fs::path& file, std::size_t line) {
    if (word.empty()) return std::numeric_limits<double>::quiet_NaN();
    double number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size())
        throw Failure(
            fmt::format("'{}', line {}: '{}' is not a number", file.string(), line, word));
    return number;
}

struct Points {
    std::vector<double> x, y;
};

// The points without the rows that have no number, in the order of x.
Points points_of(const RunProgress& run, const std::string& x, const std::string& y) {
    const std::vector<double>& xs = column_of(run, x);
    const std::vector<double>& ys = column_of(run, y);
    Points points;
    for (std::size_t i = 0; i < xs.size(); ++i) {
        if (!std::isfinite(xs[i]) || !std::isfinite(ys[i])) continue;
        if (!points.x.empty() && xs[i] < points.x.back())
            throw Failure(
                fmt::format("the column '{}' of '{}' does not grow", x, run.folder.string()), {},
                usage_error);
        points.x.push_back(xs[i]);
        points.y.push_back(ys[i]);
    }
    if (points.x.empty())
        throw Failure(fmt::format("the run '{}' has no number in the column '{}' yet",
                                  run.folder.string(), y));
    return points;
}

// The value on the line between the points; beyond them the value of the nearest.
double value_at(const Points& points, double x) {
    const auto after = std::lower_bound(points.x.begin(), points.x.end(), x);
    if (after == points.x.end()) return points.y.back();
    const auto i = static_cast<std::size_t>(after - points.x.begin());
    if (i == 0 || points.x[i] == x) return points.y[i];
    const double part = (x - points.x[i - 1]) / (points.x[i] - points.x[i - 1]);
    return points.y[i - 1] + part * (points.y[i] - points.y[i - 1]);
}

}  // namespace

RunProgress read_progress(const fs::path& folder) {
    const fs::path file = folder / "progress.csv";
    const std::string text = read_file(file, largest_text);
    RunProgress run{folder, {}, {}};
    std::size_t number = 0;
    for (std::string_view line : parts_of(text, '\n')) {
        ++number;
        if (line.ends_with('\r')) line.remove_suffix(1);  // of spreadsheets
        if (line.empty()) continue;
        const std::vector<std::string_view> words = parts_of(line, ',');
        if (run.columns.empty()) {
            run.columns.assign(words.begin(), words.end());
            run.values.resize(words.size());
            continue;
        }
        if (words.size() != run.columns.size())
            throw Failure(fmt::format("'{}', line {}: {} numbers for {} columns", file.string(),
                                      number, words.size(), run.columns.size()));
        for (std::size_t c = 0; c < words.size(); ++c)
            run.values[c].push_back(number_in(words[c], file, number));
    }
    if (run.columns.empty()) throw Failure(fmt::format("'{}' is empty", file.string()));
    return run;
}

const std::vector<double>& column_of(const RunProgress& run, const std::string& name) {
    const auto found = std::find(run.columns.begin(), run.columns.end(), name);
    if (found == run.columns.end())
        throw Failure(fmt::format("the run '{}' has no column '{}'", run.folder.string(), name),
                      fmt::format("it has {}", fmt::join(run.columns, ", ")), usage_error);
    return run.values[static_cast<std::size_t>(found - run.columns.begin())];
}

std::vector<fs::path> run_folders(const fs::path& path) {
    if (!is_folder(path))
        throw Failure(fmt::format("'{}' is not the folder of a run", path.string()), {},
                      usage_error);
    if (is_there(path / "progress.csv")) return {path};
    std::vector<fs::path> folders;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(path, error))
        if (is_there(entry.path() / "progress.csv")) folders.push_back(entry.path());
    std::sort(folders.begin(), folders.end());
    if (folders.empty())
        throw Failure(fmt::format("there is no progress.csv in '{}', nor in the folders in it",
                                  path.string()),
                      "'rddl train' writes it", usage_error);
    return folders;
}

Curve curve_of(const std::string& name, const std::vector<RunProgress>& runs, const std::string& x,
               const std::string& y) {
    std::vector<Points> all;
    for (const RunProgress& run : runs) all.push_back(points_of(run, x, y));
    Curve curve{name, static_cast<int>(runs.size()), {}, {}, {}};
    if (all.size() == 1) {
        curve.x = all[0].x;
        curve.mean = all[0].y;
        curve.deviation.assign(curve.x.size(), 0.0);
        return curve;
    }
    double first = -std::numeric_limits<double>::infinity(), last = first;
    for (const Points& points : all) {
        first = std::max(first, points.x.front());
        last = std::max(last, points.x.back());
    }
    const auto count = static_cast<double>(all.size());
    for (std::size_t place = 0; place < places; ++place) {
        const double at =
            first + (last - first) * static_cast<double>(place) / static_cast<double>(places - 1);
        double sum = 0, squares = 0;
        for (const Points& points : all) sum += value_at(points, at);
        const double mean = sum / count;
        for (const Points& points : all) {
            const double distance = value_at(points, at) - mean;
            squares += distance * distance;
        }
        curve.x.push_back(at);
        curve.mean.push_back(mean);
        curve.deviation.push_back(std::sqrt(squares / (count - 1)));
    }
    return curve;
}

std::string without_seed(const std::string& name, std::uint64_t seed) {
    const std::string ending = fmt::format("_{}", seed);
    const bool has_seed = name.size() > ending.size() && name.ends_with(ending);
    return has_seed ? name.substr(0, name.size() - ending.size()) : name;
}

namespace {

fs::path run_file(const fs::path& folder) {
    return folder / "run.json";
}

// The object of run.json, whose texts are texts; absent where there is no run.json.
std::optional<nlohmann::json> run_in(const fs::path& folder) {
    const fs::path file = run_file(folder);
    if (!is_there(file)) return std::nullopt;
    const auto fail = [&](const std::string& why) {
        throw Failure(fmt::format("'{}' is not the JSON of a run: {}", file.string(), why));
    };
    nlohmann::json run;
    try {
        run = parse_json(read_file(file, largest_text));
    } catch (const RefusedJson& refused) {
        fail(refused.what());
    }
    if (!run.is_object()) fail("it is not an object");
    for (const char* const name : {"solver", "domain", "instance"})
        if (run.contains(name) && !run[name].is_string())
            fail(fmt::format("'{}' is a text, not {}", name, json_excerpt(run[name])));
    return run;
}

}  // namespace

std::string solver_of_run(const fs::path& folder) {
    const auto run = run_in(folder);
    if (!run) return {};
    const std::string solver = run->value("solver", "");
    if (solver == "ppo" || solver == "cgp" || solver == "drp") return solver;
    throw Failure(
        fmt::format("'{}' does not state the solver of a run: '{}' is not ppo, cgp or drp",
                    run_file(folder).string(), solver));
}

std::optional<RunDescription> description_of(const fs::path& folder) {
    const auto run = run_in(folder);
    if (!run) return std::nullopt;
    if (!run->contains("seed") || !(*run)["seed"].is_number_unsigned())
        throw Failure(
            fmt::format("'{}' does not state the seed of a run", run_file(folder).string()));
    std::string what;
    for (const char* const name : {"solver", "domain", "instance"})
        if (run->contains(name)) what += (what.empty() ? "" : " ") + run->value(name, "");
    return RunDescription{what, (*run)["seed"].get<std::uint64_t>()};
}

}  // namespace rddlc::workbench
