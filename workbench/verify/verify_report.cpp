#include "verify/verify_report.hpp"

#include "formats/table.hpp"
#include "support/json_text.hpp"
#include "support/render.hpp"
#include "verify/difference_place.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace rddlc::workbench {

namespace {

using nlohmann::ordered_json;

// The reported difference and its two engines.
struct Told {
    const Difference& difference;
    const StepStart& start;
    std::string expected_by, found_by;
};

Told told(const VerifyReport& report) {
    const auto& engines = report.problem.engines;
    if (const auto& found = report.walk.disagreement) {
        const VerifiedEngine& engine = engines[found->engine];
        return {found->difference, found->start, engines[engine.reference].name, engine.name};
    }
    const PyRddlGymDisagreement& found = *report.pyrddlgym->disagreement;
    return {found.difference, found.start, "pyRDDLGym " + report.pyrddlgym->version,
            engines.front().name};
}

std::string counted(std::int64_t count, const char* word) {
    return fmt::format("{} {}{}", grouped(count), word, count == 1 ? "" : "s");
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

std::string kinds(const ValueCounts& counts) {
    std::vector<std::string> parts;
    const auto add = [&](std::int64_t count, const char* what) {
        if (count > 0) parts.push_back(fmt::format("{} {}", grouped(count), what));
    };
    add(counts.states, "of states");
    add(counts.observations, "of observations");
    add(counts.actions, "of the policy's actions");
    add(counts.rewards, "rewards");
    add(counts.conditions, "of conditions");
    add(counts.faults, "of faults");
    return joined(parts);
}

std::string starts(const Walk& walk) {
    std::vector<std::string> parts{counted(walk.episodes, "episode")};
    if (walk.random_states > 0) parts.push_back(counted(walk.random_states, "random state"));
    if (walk.recorded_states > 0) parts.push_back(counted(walk.recorded_states, "recorded state"));
    return joined(parts);
}

std::string rounding(const ValueCounts& counts, const std::string& why) {
    if (counts.rounded == 0) return "";
    return fmt::format("; {} not the same bits{}, {:.1e} apart at most",
                       counts.rounded == 1 ? "1 real is" : grouped(counts.rounded) + " reals are",
                       why, counts.largest_rounding);
}

std::string pyrddlgym_text(const PyRddlGymComparison& compared) {
    if (!compared.not_compared.empty())
        return fmt::format("; pyRDDLGym: not compared, {}", compared.not_compared);
    std::string text =
        fmt::format("; pyRDDLGym {} over {} of {}", compared.version,
                    counted(compared.counts.total(), "value"), counted(compared.steps, "step"));
    if (!compared.random.empty())
        text += fmt::format(", all but what is drawn at random ({})", joined(compared.random));
    if (compared.both_refuse > 0)
        text +=
            fmt::format(", {} that fault here also stop it", counted(compared.both_refuse, "step"));
    if (compared.left_out > 0)
        text +=
            fmt::format(", {} that pyRDDLGym refuses left out", counted(compared.left_out, "step"));
    return text + rounding(compared.counts, "");
}

std::string engine_names(const VerifiedProblem& problem) {
    std::vector<std::string> names;
    for (const VerifiedEngine& engine : problem.engines) names.push_back(engine.name);
    return joined(names);
}

// A line of `rddl replay`, which makes the step again where nothing is drawn.
std::string replay_line(const VerifyReport& report, const StepStart& start) {
    std::string line = R"({"state":)";
    report.comparison.state().write(line, start.state.data());
    if (!start.action.empty()) {
        line += R"(,"action":)";
        report.comparison.action().write_changes(
            line, start.action.data(),
            static_cast<const std::byte*>(report.problem.description().default_action));
    }
    return line + "}";
}

std::string when(const VerifyReport& report, const StepStart& start) {
    if (start.initial)
        return fmt::format("in the initial state of episode {} of environment {}, seed {}",
                           start.episode, start.environment, report.seed);
    return fmt::format("in step {} of episode {} of environment {}, seed {}", start.step,
                       start.episode, start.environment, report.seed);
}

std::string verdict_text(const VerifyReport& report) {
    if (!report.walk.disagreement)
        return "note: all engines of rddlc agree on this step\n"
               "hint: docs/dialects.md and docs/decisions.md say where rddlc differs from "
               "pyRDDLGym "
               "on purpose\n";
    const Verdict verdict = report.verdict.value_or(Verdict{});
    std::string text;
    if (verdict.pass)
        text += fmt::format(
            "note: the pass '{}' is to blame: the interpreter gives the expected "
            "value before it, and another one after it\n",
            *verdict.pass);
    else if (verdict.emitted_code)
        text +=
            "note: the emitted code is to blame: the interpreter gives the expected value after "
            "every pass\n";
    else
        text += "note: the step by itself, in the interpreter, does not differ after any pass\n";
    const auto& avoided = verdict.avoided_by ? verdict.avoided_by : verdict.pass;
    if (avoided)
        text += fmt::format("hint: 'rddl run {} --without={}' avoids it\n", report.words, *avoided);
    return text +
           "This is a mistake in rddlc, not in your problem: please report it with the files.\n";
}

}  // namespace

std::string agreement_line(const VerifyReport& report) {
    const Walk& walk = report.walk;
    std::string text =
        fmt::format("{}: all agree over {} of {} ({}; from {}): {}", report.problem.files.name,
                    counted(walk.counts.total(), "value"), counted(walk.steps, "step"),
                    kinds(walk.counts), starts(walk), engine_names(report.problem));
    text += rounding(walk.counts, report.problem.rounding.empty()
                                      ? ""
                                      : fmt::format(" by {}", joined(report.problem.rounding)));
    if (report.pyrddlgym) text += pyrddlgym_text(*report.pyrddlgym);
    return text + "\n";
}

std::string difference_text(const VerifyReport& report) {
    const auto [difference, start, expected_by, found_by] = told(report);
    const auto place = place_of(difference, start, report.problem, report.seed);
    std::string text;
    if (place) text += report.problem.sources.location(*place) + ": ";
    text += fmt::format("error: the engines differ in {}\n", difference.name);
    if (place) text += source_excerpt(report.problem.sources, *place);
    text += fmt::format("note: {}: {}\n", expected_by, difference.expected);
    text += fmt::format("note: {}: {}\n", found_by, difference.found);
    text += fmt::format("note: {}, from: {}\n", when(report, start), replay_line(report, start));
    text += verdict_text(report);
    const Walk& walk = report.walk;
    return text + fmt::format("Before it {} of {} agreed.\n", counted(walk.counts.total(), "value"),
                              counted(walk.steps, "step"));
}

std::string invalid_program_text(const VerifiedProblem& problem, const std::string& words) {
    return fmt::format(
        "{}: error: the pass '{}' makes a program that is not valid: {}\n"
        "hint: 'rddl run {} --without={}' avoids it\n"
        "This is a mistake in rddlc, not in your problem: please report it with the files.\n",
        problem.files.name, problem.invalid->pass, problem.invalid->complaint, words,
        problem.invalid->pass);
}

// ------------------------------------------------------------------------------------------ JSON

namespace {

ordered_json counts_json(const ValueCounts& counts) {
    return {{"total", counts.total()},
            {"states", counts.states},
            {"observations", counts.observations},
            {"actions", counts.actions},
            {"rewards", counts.rewards},
            {"conditions", counts.conditions},
            {"faults", counts.faults},
            {"rounded", counts.rounded},
            {"largest_rounding", counts.largest_rounding}};
}

ordered_json difference_json(const VerifyReport& report) {
    const auto [difference, start, expected_by, found_by] = told(report);
    const auto place = place_of(difference, start, report.problem, report.seed);
    ordered_json object{{"what", difference.name},
                        {"expected", {{"engine", expected_by}, {"value", difference.expected}}},
                        {"found", {{"engine", found_by}, {"value", difference.found}}}};
    if (place) {
        object["place"] = report.problem.sources.location(*place);
        object["text"] = report.problem.sources.text(*place);
    }
    object["environment"] = start.environment;
    object["episode"] = start.episode;
    object["step"] = start.step;
    object["from"] = parse_ordered_json(replay_line(report, start));
    const Verdict verdict = report.verdict.value_or(Verdict{});
    object["pass"] = verdict.pass ? ordered_json(*verdict.pass) : ordered_json();
    object["emitted_code"] = verdict.emitted_code;
    object["avoided_by"] = verdict.avoided_by ? ordered_json(*verdict.avoided_by) : ordered_json();
    return object;
}

ordered_json pyrddlgym_json(const PyRddlGymComparison& compared) {
    if (!compared.not_compared.empty()) return {{"not_compared", compared.not_compared}};
    return {{"version", compared.version},
            {"steps", compared.steps},
            {"values", counts_json(compared.counts)},
            {"random", compared.random},
            {"both_refuse", compared.both_refuse},
            {"left_out", compared.left_out},
            {"first_refusal", compared.first_refusal}};
}

}  // namespace

ordered_json invalid_program_json(const VerifiedProblem& problem) {
    return {{"problem", problem.files.name},
            {"agree", false},
            {"pass", problem.invalid->pass},
            {"complaint", problem.invalid->complaint}};
}

ordered_json report_json(const VerifyReport& report) {
    const Walk& walk = report.walk;
    ordered_json json{{"problem", report.problem.files.name}, {"agree", report.agrees()}};
    json["engines"] = ordered_json::array();
    for (const VerifiedEngine& engine : report.problem.engines)
        json["engines"].push_back(engine.name);
    json["seed"] = report.seed;
    json["steps"] = walk.steps;
    json["episodes"] = walk.episodes;
    json["random_states"] = walk.random_states;
    json["recorded_states"] = walk.recorded_states;
    json["values"] = counts_json(walk.counts);
    if (report.pyrddlgym) json["pyrddlgym"] = pyrddlgym_json(*report.pyrddlgym);
    if (!report.agrees()) json["difference"] = difference_json(report);
    return json;
}

}  // namespace rddlc::workbench
