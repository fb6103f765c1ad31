#include "render/state_text.hpp"

#include "render/panels.hpp"

#include <cmath>

namespace rddl::render {

namespace {

std::string true_objects(const Snapshot& snapshot, const Values& values) {
    std::string text;
    for (std::size_t g = 0; g < values.numbers.size(); ++g) {
        if (values.numbers[g] == 0) continue;
        const std::string name =
            snapshot.world().name_of(*values.fluent, static_cast<std::int64_t>(g));
        const std::size_t open = name.find('(');
        std::string objects = name.substr(open + 1, name.size() - open - 2);
        if (values.fluent->rank > 1) objects = "(" + objects + ")";
        text += (text.empty() ? "" : " ") + objects;
    }
    return text.empty() ? "none" : text;
}

// Two values that are nan count as the same.
bool differ(double a, double b) {
    return a != b && !(std::isnan(a) && std::isnan(b));
}

}  // namespace

std::vector<TextLine> state_lines(const Snapshot& snapshot) {
    std::vector<TextLine> lines;
    const auto& steps = snapshot.steps();
    const Step* const before = steps.size() > 1 ? &steps[steps.size() - 2] : nullptr;
    for (const rddl_fluent* const fluent : state_fluents(snapshot.problem())) {
        const Values& values = snapshot.values(*fluent);
        const Values last = before ? snapshot.values_in(*before, *fluent) : values;
        if (fluent->scalar == RDDL_BOOL && fluent->rank > 0) {
            lines.push_back(
                {fluent->name, true_objects(snapshot, values), values.numbers != last.numbers});
            continue;
        }
        for (std::size_t g = 0; g < values.numbers.size(); ++g)
            lines.push_back({snapshot.world().name_of(*fluent, static_cast<std::int64_t>(g)),
                             value_text(values, g), differ(values.numbers[g], last.numbers[g])});
    }
    return lines;
}

std::string action_text(const Snapshot& snapshot) {
    std::string text;
    std::size_t left_out = 0;
    const rddl_problem& problem = snapshot.problem();
    Step passive;  // whose actions are the default's
    for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent& fluent = *rddl_fluent_at(&problem, f);
        if (fluent.role != RDDL_ACTION) continue;
        const Values& taken = snapshot.values(fluent);
        const Values usual = snapshot.values_in(passive, fluent);
        for (std::size_t g = 0; g < taken.numbers.size(); ++g) {
            if (taken.numbers[g] == usual.numbers[g]) continue;
            if (text.size() > 2000) {
                ++left_out;
                continue;
            }
            std::string name = snapshot.world().name_of(fluent, static_cast<std::int64_t>(g));
            if (fluent.scalar != RDDL_BOOL)
                name += " = " + value_text(taken, g);
            else if (taken.numbers[g] == 0)
                name = "not " + name;
            text += (text.empty() ? "" : ", ") + name;
        }
    }
    if (left_out > 0) return text + ", +" + std::to_string(left_out) + " more";
    return text.empty() ? "default" : text;
}

}  // namespace rddl::render
