#include "verify/pyrddlgym_outcomes.hpp"

#include "driver/process.hpp"
#include "driver/work_folder.hpp"
#include "python/python_command.hpp"
#include "support/failure.hpp"
#include "support/files.hpp"
#include "support/json_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <limits>
#include <set>

namespace rddlc::workbench {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

void write_questions(const fs::path& file, const OutcomeComparison& comparison,
                     const std::vector<StepSample>& samples) {
    std::string lines;
    for (const StepSample& sample : samples) {
        lines += R"({"state":)";
        comparison.state().write(lines, sample.start.state.data());
        lines += R"(,"action":)";
        comparison.action().write(lines, sample.start.action.data());
        lines += "}\n";
    }
    UsedFiles used;
    write_file(file, lines, used);
}

std::vector<json> read_answers(const fs::path& file) {
    std::vector<json> answers;
    std::ifstream in(file, std::ios::binary);
    for (std::string line; std::getline(in, line);) {
        json answer = json_if_valid(line);
        if (!answer.is_object()) break;  // a line that was cut
        answers.push_back(std::move(answer));
    }
    return answers;
}

double real_of(const json& value) {
    return number_in_json(value).value_or(std::numeric_limits<double>::quiet_NaN());
}

// Answers as outcomes, without what draws take part in.
class Answers {
  public:
    Answers(const json& header, const rddl_problem& problem, const OutcomeComparison& comparison)
        : problem_(problem), comparison_(comparison) {
        for (const json& name : header["random"]) random_.insert(name.get<std::string>());
        random_reward_ = header["random_reward"].get<bool>();
        random_ending_ = header["random_ending"].get<bool>();
    }

    bool anything_random() const { return !random_.empty() || random_reward_ || random_ending_; }

    std::vector<std::string> random() const {
        std::vector<std::string> names(random_.begin(), random_.end());
        if (random_reward_) names.emplace_back("the reward");
        if (random_ending_) names.emplace_back("the end of the episode");
        return names;
    }

    // A value that depends on draws is taken from `ours`.
    StepOutcome outcome(const json& answer, const StepOutcome& ours) const {
        StepOutcome theirs;
        theirs.action = ours.action;
        theirs.violated_precondition = precondition(answer, ours);
        theirs.state = record(comparison_.state(), answer["state"], ours.state);
        if (problem_.partially_observed)
            theirs.observation =
                record(comparison_.observation(), answer["observation"], ours.observation);
        theirs.reward = random_reward_ ? ours.reward : real_of(answer["reward"]);
        theirs.causes = causes(answer, ours);
        return theirs;
    }

    void count(ValueCounts& counts) const {
        counts.states += fixed(comparison_.state());
        if (problem_.partially_observed) counts.observations += fixed(comparison_.observation());
        counts.rewards += !random_reward_;
        counts.conditions += problem_.precondition_count > 0;
        if (!random_ending_)
            counts.conditions += (problem_.invariant_count > 0) + (problem_.termination_count > 0);
    }

  private:
    bool is_random(const RecordEntry& entry) const { return random_.contains(entry.fluent->name); }

    std::int64_t fixed(const RecordLayout& layout) const {
        return std::ranges::count_if(layout.entries(),
                                     [&](const RecordEntry& entry) { return !is_random(entry); });
    }

    // pyRDDLGym reports whether an action is legal, not what it violates.
    static std::int32_t precondition(const json& answer, const StepOutcome& ours) {
        const bool legal = answer["legal"].get<bool>();
        if (legal == (ours.violated_precondition < 0)) return ours.violated_precondition;
        return legal ? -1 : 0;
    }

    Record record(const RecordLayout& layout, const json& values, const Record& ours) const {
        Record record = ours;
        if (const auto message = layout.read(values, record.data()))
            throw Failure("pyRDDLGym's answer cannot be read: " + *message);
        for (const RecordEntry& entry : layout.entries())
            if (is_random(entry))
                std::memcpy(record.data() + entry.offset, ours.data() + entry.offset,
                            scalar_size(entry.fluent->scalar));
        return record;
    }

    std::uint8_t causes(const json& answer, const StepOutcome& ours) const {
        if (random_ending_) return ours.causes;
        int causes = ours.causes & RDDL_TRUNCATED_HORIZON;  // steps, not episodes, are compared
        if (answer["terminated"].get<bool>()) causes |= RDDL_TERMINATED;
        if (answer["truncated"].get<bool>()) causes |= RDDL_TRUNCATED_INVARIANT;
        return static_cast<std::uint8_t>(causes);
    }

    const rddl_problem& problem_;
    const OutcomeComparison& comparison_;
    std::set<std::string, std::less<>> random_;
    bool random_reward_ = false, random_ending_ = false;
};

void compare_answer(const json& answer, const StepSample& sample, const Answers& answers,
                    const OutcomeComparison& comparison, const PyRddlGymOptions& options,
                    PyRddlGymComparison& result) {
    const bool refused = answer.contains("refused");
    const bool faulted = !sample.outcome.fault.empty();
    if (refused && faulted) {
        ++result.both_refuse;
        return;
    }
    // Whether a draw's parameter is good may depend on other draws.
    if (refused || (faulted && answers.anything_random())) {
        if (refused && result.left_out == 0) result.first_refusal = answer["refused"];
        ++result.left_out;
        return;
    }
    ++result.steps;
    StepOutcome theirs = answers.outcome(answer, sample.outcome);
    if (faulted) theirs.state = sample.outcome.state;
    ValueCounts counts = result.counts;
    auto difference = comparison.compare(theirs, sample.outcome, options.tolerance, counts);
    if (difference && options.rounded_otherwise) {
        counts = result.counts;
        difference = comparison.compare(theirs, sample.outcome, options.tolerance, counts,
                                        options.rounded_otherwise(sample.start));
    }
    result.counts = counts;
    if (difference)
        result.disagreement = PyRddlGymDisagreement{*std::move(difference), sample.start};
    else
        answers.count(result.counts);
}

// The last line of what a failing program wrote.
std::string last_line(const std::string& output) {
    const std::size_t end = output.find_last_not_of('\n');
    if (end == std::string::npos) return "it says nothing";
    const std::size_t line_break = output.rfind('\n', end);
    return output.substr(line_break == std::string::npos ? 0 : line_break + 1,
                         end - (line_break == std::string::npos ? 0 : line_break));
}

// Why nothing can be compared, if so.
std::string excuse(const std::vector<json>& answers, const std::string& output) {
    if (answers.empty()) return "it cannot be run: " + last_line(output);
    const json& header = answers.front();
    if (header.contains("missing")) return "it is not installed";
    if (header.contains("error"))
        return "it cannot read this problem: " + header["error"].get<std::string>();
    return "";
}

}  // namespace

PyRddlGymComparison compare_with_pyrddlgym(const ProblemFiles& files, const rddl_problem& problem,
                                           const OutcomeComparison& comparison,
                                           const std::vector<StepSample>& samples,
                                           const PyRddlGymOptions& options) {
    PyRddlGymComparison result;
    const TemporaryFolder folder;
    const fs::path questions = folder.path() / "questions",
                   answers_file = folder.path() / "answers";
    write_questions(questions, comparison, samples);
    const std::string python = python_command(options.python);
    const PythonFiles read = files_for_python(files, folder.path());
    // Reading a large problem takes it minutes.
    const std::chrono::seconds limit{300 + static_cast<std::int64_t>(options.seconds)};
    const auto process =
        run_process({python, "-c", std::string(pyrddlgym_outcomes_program), read.domain.string(),
                     read.instance.string(), questions.string(), answers_file.string(),
                     fmt::format("{}", options.seconds)},
                    {}, limit);
    if (!process) {
        result.not_compared = fmt::format("there is no '{}'", python);
        return result;
    }
    if (process->timed_out) {
        result.not_compared = fmt::format("'{}' has no end within {} s", python, limit.count());
        return result;
    }
    const std::vector<json> lines = read_answers(answers_file);
    result.not_compared = excuse(lines, process->output);
    if (!result.not_compared.empty()) return result;
    result.version = lines.front()["version"].get<std::string>();
    const Answers answers(lines.front(), problem, comparison);
    result.random = answers.random();
    for (std::size_t i = 1; i < lines.size() && i <= samples.size() && !result.disagreement; ++i)
        compare_answer(lines[i], samples[i - 1], answers, comparison, options, result);
    return result;
}

}  // namespace rddlc::workbench
