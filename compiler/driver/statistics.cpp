#include "driver/statistics.hpp"

#include "support/json_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace rddlc {
namespace {

using nlohmann::ordered_json;

// "tables made scalars: 12, ..."
std::string deeds(const passes::Report& report) {
    std::string text;
    for (const auto& [what, count] : report) {
        if (count == 0) continue;
        text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", what, count);
    }
    return text;
}

std::string line(std::size_t width, std::string_view name, const ProgramSize& size,
                 const std::string& time, const std::string& did) {
    const std::string text = fmt::format("{:{}}  {:>7}  {:>12.0f}  {:>8}  {}", name, width,
                                         size.nodes, size.operations, time, did);
    return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
}

ordered_json before_and_after(auto before, auto after) {
    return {{"before", before}, {"after", after}};
}

}  // namespace

std::string statistics_text(const std::vector<PassRun>& runs) {
    std::size_t width = 0;
    for (const PassRun& run : runs) width = std::max(width, run.name.size());
    std::string text = fmt::format("{:{}}  {:>7}  {:>12}  {:>8}  {}\n", "pass", width, "nodes",
                                   "operations", "ms", "what it did");
    text += line(width, "(before)", runs.front().before, "", "");
    for (const PassRun& run : runs) {
        text += line(width, run.name, run.after, fmt::format("{:.2f}", run.time.count() * 1e3),
                     run.undone ? "undone: a step would cost more" : deeds(run.report));
    }
    return text;
}

std::string statistics_json(const std::vector<PassRun>& runs) {
    ordered_json array = ordered_json::array();
    for (const PassRun& run : runs) {
        ordered_json did = ordered_json::object();
        for (const auto& [what, count] : run.report) {
            if (count != 0) did[what] = count;
        }
        array.push_back(
            {{"pass", run.name},
             {"did", did},
             {"undone", run.undone},
             {"nodes", before_and_after(run.before.nodes, run.after.nodes)},
             {"operations", before_and_after(run.before.operations, run.after.operations)},
             {"milliseconds", run.time.count() * 1e3}});
    }
    return json_document(array);
}

}  // namespace rddlc
