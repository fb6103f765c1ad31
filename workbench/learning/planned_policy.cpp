#include "learning/planned_policy.hpp"

#include "support/json_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace rddlc::workbench {

Explanations::Explanations(PlannerSettings& settings, const rddl_problem& problem,
                           const UsedFiles& used)
    : problem_(problem), actions_(problem, RDDL_ACTION) {
    if (settings.explanations.empty()) return;
    file_.emplace(settings.explanations, used);
    settings.explain = [this](const planners::Explanation& explanation) {
        take(explanation);
    };
}

void Explanations::take(const planners::Explanation& explanation) {
    std::string line = line_of(explanation);
    const std::scoped_lock lock(mutex_);
    lines_.insert_or_assign({explanation.episode, explanation.step}, std::move(line));
}

std::string Explanations::line_of(const planners::Explanation& explanation) const {
    const auto number = [](double value) {
        return json_line(nlohmann::ordered_json(json_number(value)));
    };
    std::string line =
        fmt::format(R"("episode":{},"step":{},"depth":{},"iterations":{},"steps":{},"chosen":{},)",
                    explanation.episode, explanation.step, explanation.depth,
                    explanation.iterations, explanation.steps, explanation.chosen);
    if (explanation.particles) line += fmt::format(R"("particles":{},)", *explanation.particles);
    if (!explanation.note.empty())
        line += fmt::format(R"("note":{},)", json_line(nlohmann::ordered_json(explanation.note)));
    line += R"("candidates":[)";
    for (const planners::Explanation::Candidate& candidate : explanation.candidates) {
        if (&candidate != explanation.candidates.data()) line += ',';
        line += fmt::format(R"({{"name":"{}","value":{},"error":{},"trials":{},"action":)",
                            candidate.name, number(candidate.value), number(candidate.error),
                            candidate.trials);
        actions_.write_changes(line, candidate.action.data(),
                               static_cast<const std::byte*>(problem_.default_action));
        line += '}';
    }
    return line + "]}\n";
}

void Explanations::write(const std::string& policy) {
    if (!file_) return;
    const std::string name = json_line(nlohmann::ordered_json(policy));
    for (const auto& [place, line] : lines_)
        file_->write(fmt::format(R"({{"policy":{},{})", name, line));
    lines_.clear();
}

void Explanations::finish() {
    if (file_) file_->finish();
}

}  // namespace rddlc::workbench
