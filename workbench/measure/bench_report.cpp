#include "measure/bench_report.hpp"

#include "formats/number_text.hpp"
#include "formats/table.hpp"
#include "support/json_text.hpp"
#include "support/program.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace rddlc::workbench {

namespace {

std::string bytes_text(double bytes) {
    if (bytes >= 999.5e3) return fmt::format("{:.3g} MB", bytes / 1e6);
    if (bytes >= 999.5) return fmt::format("{:.3g} kB", bytes / 1e3);
    return fmt::format("{:.3g} bytes", bytes);
}

std::string build_text(const LoadCosts& costs) {
    return costs.build_seconds ? seconds_text(*costs.build_seconds)
                               : "spared by the cache (--no-cache measures it)";
}

void print_costs(const BenchReport& report) {
    const LoadCosts& costs = report.costs;
    TextTable table({{""}, {""}});
    table.add_row({"rddlc", seconds_text(costs.compile_seconds)});
    if (report.engine == Engine::Compiled) {
        table.add_row({"C++ compiler", build_text(costs)});
        table.add_row(
            {"emitted", fmt::format("{} lines, {}; shared object {}", grouped(costs.emitted_lines),
                                    bytes_text(static_cast<double>(costs.emitted_bytes)),
                                    bytes_text(static_cast<double>(costs.object_bytes)))});
    }
    if (report.first_step_seconds)
        table.add_row(
            {"first step", seconds_text(*report.first_step_seconds) + " after the files"});
    if (report.memory_per_environment)
        table.add_row({"memory", bytes_text(*report.memory_per_environment) + " per environment"});
    table.add_row({"reals", std::string(name_of(report.real))});
    if (report.lanes > 1)
        table.add_row(
            {"packs", fmt::format("{} environments ({})", report.lanes, report.instruction_set)});
    print("{}\n", table.text());
}

void print_measurements(const std::vector<Measurement>& all) {
    TextTable table({{"environments", Align::Right},
                     {"lanes", Align::Right},
                     {"threads", Align::Right},
                     {"steps/s", Align::Right},
                     {"one step", Align::Right},
                     {"speed-up", Align::Right}});
    for (const Measurement& m : all)
        table.add_row({grouped(m.environments), std::to_string(m.lanes), std::to_string(m.threads),
                       rate_text(m.steps_per_second()), seconds_text(1 / m.steps_per_second()),
                       fmt::format("{:.2f}", m.steps_per_second() / all[0].steps_per_second())});
    print("{}", table.text());
}

bool is_slower(const Measurement& a, const Measurement& b) {
    return a.steps_per_second() < b.steps_per_second();
}

// Our best speed under the same conditions: one environment against one, batches against batches,
// with as many threads. Nothing without such a measurement.
std::optional<double> best_rival(const std::vector<Measurement>& ours, const Measurement& peer) {
    std::optional<double> best;
    for (const Measurement& m : ours)
        if (m.threads == peer.threads && (m.environments == 1) == (peer.environments == 1))
            best = std::max(best.value_or(0), m.steps_per_second());
    return best;
}

void print_peers(const BenchReport& report) {
    TextTable table({{"against"},
                     {"environments", Align::Right},
                     {"threads", Align::Right},
                     {"steps/s", Align::Right},
                     {"rddlc is faster by", Align::Right}});
    for (const PeerFigures& peer : report.peers) {
        const auto best =
            std::max_element(peer.measurements.begin(), peer.measurements.end(), is_slower);
        for (const Measurement& m : peer.measurements) {
            const auto ours = best_rival(report.measurements, m);
            table.add_row({peer.name + " " + peer.version + (&m == &*best ? ", best" : ""),
                           grouped(m.environments), std::to_string(m.threads),
                           rate_text(m.steps_per_second()),
                           ours ? fmt::format("{:.3g}", *ours / m.steps_per_second()) : "-"});
        }
    }
    print("\n{}\n", table.text());
    for (const PeerFigures& peer : report.peers)
        print("{}: first step {} after the files; before, {} to import it\n", peer.name,
              seconds_text(peer.first_step_seconds), seconds_text(peer.import_seconds));
}

nlohmann::ordered_json to_json(const std::vector<Measurement>& all) {
    nlohmann::ordered_json out = nlohmann::ordered_json::array();
    for (const Measurement& m : all) {
        nlohmann::ordered_json figures{{"environments", m.environments}};
        if (m.lanes > 0) figures["lanes"] = m.lanes;
        figures["threads"] = m.threads;
        figures["steps"] = m.steps;
        figures["seconds"] = m.seconds;
        if (m.processor_seconds > 0) figures["processor_seconds"] = m.processor_seconds;
        figures["steps_per_second"] = m.steps_per_second();
        out.push_back(std::move(figures));
    }
    return out;
}

nlohmann::ordered_json to_json(const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nullptr;
}

nlohmann::ordered_json to_json(const BenchReport& report) {
    const LoadCosts& costs = report.costs;
    nlohmann::ordered_json peers = nlohmann::ordered_json::array();
    for (const PeerFigures& peer : report.peers)
        peers.push_back({{"name", peer.name},
                         {"version", peer.version},
                         {"import_seconds", peer.import_seconds},
                         {"first_step_seconds", peer.first_step_seconds},
                         {"measurements", to_json(peer.measurements)}});
    return {{"problem", report.problem},
            {"engine", name_of(report.engine)},
            {"real", name_of(report.real)},
            {"lanes", report.lanes},
            {"instruction_set", report.instruction_set},
            {"rddlc_seconds", costs.compile_seconds},
            {"cxx_seconds", to_json(costs.build_seconds)},
            {"first_step_seconds", to_json(report.first_step_seconds)},
            {"emitted_lines", costs.emitted_lines},
            {"emitted_bytes", costs.emitted_bytes},
            {"object_bytes", costs.object_bytes},
            {"bytes_per_environment", to_json(report.memory_per_environment)},
            {"episodes", report.episodes},
            {"faulted", report.faulted},
            {"measurements", to_json(report.measurements)},
            {"peers", peers}};
}

}  // namespace

void print_table(const BenchReport& report) {
    print("{}, {}: random legal actions drawn beforehand, resets included\n\n", report.problem,
          name_of(report.engine));
    print_costs(report);
    print_measurements(report.measurements);
    if (!report.peers.empty()) print_peers(report);
}

void print_json(const BenchReport& report) {
    print("{}", json_document(to_json(report)));
}

}  // namespace rddlc::workbench
