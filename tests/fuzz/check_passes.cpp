// Holds the passes to their contracts on one problem after the other, in one process.
//
//   fuzz_passes
//       reads one JSON object a line, writes one a line:
//       {"text": "domain d { ... } ...", "seed": 7, "steps": 20, "wild": true, "fast_math": false,
//        "without": ["count_bits"], "all_stages": false}
//       {"outcome": "accepted", "operations": 812, "changed": {"count_bits": 1}, "breaches":
//        [{"pass": "count_bits", "text": "step 0: ..."}], "error": ""}
//   fuzz_passes FILE...
//       one problem as it is, with --seed, --steps, --wild, --fast-math, --without
//   fuzz_passes --each FILE...
//       each file is a problem: with tame and with wild values, and with --fast-math
//   fuzz_passes --list
//       the names of all passes; behind those that only run with --fast-math: "fast_math"
//
// A problem that takes longer than 20 seconds of the processor ends the program, by a signal.
#include "exercise.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/time.h>

#include <array>
#include <exception>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace rddlc::fuzzing {
namespace {

using nlohmann::json;

constexpr time_t longest_run = 20;  // seconds of the processor

void limit_processor_time(time_t seconds) {
    const itimerval limit{.it_interval = {}, .it_value = {.tv_sec = seconds, .tv_usec = 0}};
    setitimer(ITIMER_PROF, &limit, nullptr);
}

Exercise exercise_of(const json& request) {
    Exercise how;
    how.seed = request.value("seed", how.seed);
    how.steps = request.value("steps", 20);
    how.values = request.value("wild", false) ? Values::Wild : Values::Tame;
    how.all_stages = request.value("all_stages", false);
    how.passes.fast_math = request.value("fast_math", false);
    for (const json& name : request.value("without", json::array()))
        how.passes.without.insert(name);
    return how;
}

json answer_to(const json& request) {
    constexpr std::array outcomes = {"rejected", "accepted", "too large"};
    json answer = {{"outcome", ""}, {"error", ""}, {"breaches", json::array()}};
    try {
        const Exercised result =
            exercise(request.at("text").get<std::string>(), exercise_of(request));
        answer["outcome"] = outcomes[static_cast<std::size_t>(result.outcome)];
        answer["operations"] = result.operations;
        answer["changed"] = result.changed;
        if (result.outcome == Outcome::Rejected) answer["error"] = result.complaints;
        for (const Breach& breach : result.breaches) {
            answer["breaches"].push_back({{"pass", breach.pass}, {"text", breach.text}});
        }
    } catch (const std::exception& error) {
        answer["error"] = error.what();
    }
    return answer;
}

void answer_all() {
    for (std::string line; std::getline(std::cin, line);) {
        limit_processor_time(longest_run);
        std::cout
            << answer_to(json::parse(line)).dump(-1, ' ', false, json::error_handler_t::replace)
            << std::endl;
    }
}

std::string read(const std::vector<std::string>& files) {
    std::ostringstream text;
    for (const std::string& file : files) text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

// Whether the passes keep their contracts on all of them.
bool check_each(const std::vector<std::string>& files) {
    bool all_good = true;
    for (const std::string& file : files) {
        for (const char* const values : {"tame", "wild", "fast_math"}) {
            const json answer =
                answer_to({{"text", read({file})}, {values, true}, {"all_stages", true}});
            const bool is_good = answer["outcome"] == "accepted" && answer["breaches"].empty();
            if (!is_good) fmt::print("{}, {}: {}\n", file, values, answer.dump(2));
            all_good = all_good && is_good;
        }
    }
    return all_good;
}

void list_passes() {
    for (const PassDescription& pass : all_passes())
        fmt::print("{}{}\n", pass.name, pass.only_fast_math ? " fast_math" : "");
}

}  // namespace
}  // namespace rddlc::fuzzing

int main(int argc, char** argv) {
    using namespace rddlc::fuzzing;
    std::vector<std::string> files, without;
    std::uint64_t seed = 1;
    int steps = 20;
    bool wild = false, fast_math = false, list = false, each = false;
    CLI::App app("Holds the passes to their contracts.");
    app.add_option("files", files, "of one problem; without any: JSON from stdin")
        ->check(CLI::ExistingFile);
    app.add_option("--seed", seed, "of actions, states and draws");
    app.add_option("--steps", steps);
    app.add_option("--without", without, "leave out a pass");
    app.add_flag("--wild", wild, "states that round, and are not finite");
    app.add_flag("--fast-math", fast_math);
    app.add_flag("--each", each, "each file is a problem of its own");
    app.add_flag("--list", list, "the names of all passes");
    CLI11_PARSE(app, argc, argv);
    if (list) {
        list_passes();
        return 0;
    }
    if (files.empty()) {
        answer_all();
        return 0;
    }
    if (each) return check_each(files) ? 0 : 1;
    const json request = {{"text", read(files)}, {"seed", seed},       {"steps", steps},
                          {"wild", wild},        {"without", without}, {"fast_math", fast_math}};
    const json answer = answer_to(request);
    fmt::print("{}\n", answer.dump(2));
    return answer["breaches"].empty() && answer["error"] == "" ? 0 : 1;
}
