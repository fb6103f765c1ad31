#include "engines/faults.hpp"
#include "formats/description.hpp"
#include "formats/number_text.hpp"
#include "formats/table.hpp"
#include "model/expression_text.hpp"
#include "vocabulary/vocabulary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rddlc::workbench {

namespace {

constexpr std::size_t text_width = 96;

// "1 bool", "2 bools"
std::string counted(std::int64_t count, std::string_view what) {
    return fmt::format("{} {}{}", grouped(count), what, count == 1 ? "" : "s");
}

// The choices of a solver that changes one action value at a time (simulator.h).
std::string choices_text(const rddl_simulator& simulator) {
    const std::int64_t count = simulator.action_choice_count(&simulator);
    if (count == 1) return "1: the default";
    return fmt::format("{}: the default, or {} of one value", grouped(count),
                       counted(count - 1, "change"));
}

std::string general_section(const ProblemDescription& d) {
    const rddl_problem& problem = *d.simulator->problem;
    TextTable table({{""}, {""}});
    table.add_row({"domain", fmt::format("{} ({})", problem.domain, d.files.domain.string())});
    const std::filesystem::path& instance = d.files.instance.value_or(d.files.domain);
    table.add_row({"instance", fmt::format("{} ({})", problem.instance, instance.string())});
    table.add_row({"horizon", problem.horizon == 0 ? "none" : counted(problem.horizon, "step")});
    table.add_row({"discount", number_text(problem.discount)});
    const auto& limit = d.characteristics.max_nondef_actions;
    const std::int64_t actions = d.characteristics.action.total();
    table.add_row(
        {"actions at once", limit ? fmt::format("at most {} of {} may differ from the default",
                                                grouped(*limit), grouped(actions))
                                  : "no limit"});
    table.add_row({"action choices", choices_text(*d.simulator)});
    return table.text();
}

// ------------------------------------------------------------------------------------ objects

std::string object_list(const model::Type& type) {
    constexpr std::size_t width = 60;
    std::string all = fmt::format("{}", fmt::join(type.objects, ", "));
    return shortened(all, width);
}

std::string objects_section(const model::Model& model) {
    if (model.types.empty()) return {};
    TextTable table({{"type"}, {"kind"}, {"objects", Align::Right}, {""}});
    for (const model::Type& type : model.types)
        table.add_row({type.name, type.enumerated ? "enumerated" : "object",
                       grouped(static_cast<long long>(type.objects.size())), object_list(type)});
    return '\n' + table.text();
}

// ------------------------------------------------------------------------------------ fluents

std::string parameters_text(const model::Model& model, const model::Fluent& fluent) {
    std::vector<std::string> names;
    for (const model::TypeId type : fluent.parameters) names.push_back(model.types[type].name);
    return shortened(fmt::format("{}", fmt::join(names, ", ")), 26);
}

std::string shape_text(const model::Model& model, const model::Fluent& fluent) {
    std::vector<std::size_t> sizes;
    for (const model::TypeId type : fluent.parameters)
        sizes.push_back(model.types[type].objects.size());
    return fmt::format("{}", fmt::join(sizes, " x "));
}

std::string default_text(const model::Model& model, const model::Fluent& fluent) {
    if (!fluent.default_value) return "";
    return shortened(model::text_of(model, fluent.range, *fluent.default_value), 12);
}

// "[0, 100]"; if groundings differ, the range that holds them all and a star.
std::string bounds_text(const rddl_fluent& fluent) {
    if (!fluent.lower || !fluent.upper || fluent.count == 0) return "";
    const auto [least_lower, most_lower] =
        std::minmax_element(fluent.lower, fluent.lower + fluent.count);
    const auto [least_upper, most_upper] =
        std::minmax_element(fluent.upper, fluent.upper + fluent.count);
    if (std::isinf(*least_lower) && std::isinf(*most_upper)) return "";
    const bool differ = *least_lower != *most_lower || *least_upper != *most_upper;
    return fmt::format("{}{}, {}{}{}", std::isinf(*least_lower) ? '(' : '[',
                       number_text(*least_lower), number_text(*most_upper),
                       std::isinf(*most_upper) ? ')' : ']', differ ? "*" : "");
}

std::string role_text(Role role) {
    const std::string name(rddlc::name_of(role));
    return role == Role::NonFluent ? name : name.substr(0, name.find("-fluent"));
}

std::string fluents_section(const ProblemDescription& d) {
    TextTable table({{"fluent"},
                     {"role"},
                     {"parameters"},
                     {"shape"},
                     {"count", Align::Right},
                     {"range"},
                     {"default"},
                     {"bounds"},
                     {"line", Align::Right}});
    bool any_differ = false;
    for (std::size_t f = 0; f < d.model.domain_fluents().size(); ++f) {
        const model::Fluent& fluent = d.model.fluents[f];
        const rddl_fluent& described = d.simulator->problem->fluents[f];
        const std::string bounds = bounds_text(described);
        any_differ = any_differ || bounds.ends_with('*');
        table.add_row({fluent.name, role_text(fluent.role), parameters_text(d.model, fluent),
                       shape_text(d.model, fluent), grouped(described.count),
                       model::text_of(d.model, fluent.range), default_text(d.model, fluent), bounds,
                       std::to_string(described.source.line)});
    }
    return '\n' + table.text() + (any_differ ? "* differ between groundings\n" : "");
}

// ------------------------------------------------------------------------------------- policy

std::string policy_section(const ProblemDescription& d) {
    const rddl_policy* const policy = d.simulator->policy;
    if (!policy) return {};
    std::string text =
        fmt::format("\npolicy {} ({}:{}): {}, remembers {}\n", policy->name, policy->source.file,
                    policy->source.line, policy->stochastic ? "stochastic" : "deterministic",
                    counted(policy->memory_size, "byte"));
    if (d.model.policy_fluents().empty()) return text;
    TextTable table({{"fluent"}, {"role"}, {"parameters"}, {"shape"}, {"range"}, {"default"}});
    for (const model::Fluent& fluent : d.model.policy_fluents())
        table.add_row({fluent.name, role_text(fluent.role), parameters_text(d.model, fluent),
                       shape_text(d.model, fluent), model::text_of(d.model, fluent.range),
                       default_text(d.model, fluent)});
    return text + table.text();
}

// -------------------------------------------------------------------------------------- sizes

std::string sizes_section(const ProblemDescription& d) {
    const rddl_problem& problem = *d.simulator->problem;
    const Characteristics& c = d.characteristics;
    TextTable table({{"record"},
                     {"values", Align::Right},
                     {"bool", Align::Right},
                     {"int", Align::Right},
                     {"object", Align::Right},
                     {"real", Align::Right},
                     {"bytes", Align::Right}});
    const auto add = [&](const char* name, const ValueKinds& kinds, std::int64_t bytes) {
        table.add_row({name, grouped(kinds.total()), grouped(kinds.bools), grouped(kinds.ints),
                       grouped(kinds.objects), grouped(kinds.reals), grouped(bytes)});
    };
    add("state", c.state, problem.state_size);
    add("action", c.action, problem.action_size);
    if (c.partially_observed) add("observation", c.observation, problem.observation_size);
    return '\n' + table.text();
}

// ---------------------------------------------------------------------------- characteristics

std::string randomness_text(const Characteristics& c) {
    if (!c.stochastic()) return "deterministic";
    std::vector<std::string> places = c.random_cpfs;
    if (c.random_reward) places.push_back("reward");
    if (c.random_conditions) places.push_back("conditions");
    if (c.random_initial_state) places.push_back("initial state");
    return fmt::format("stochastic: {}", fmt::join(places, ", "));
}

std::string actions_text(const Characteristics& c) {
    const std::string kind = c.action.text();
    if (c.action.total() == 0) return "none";
    return kind + (c.concurrent() ? ", concurrent" : ", one at a time");
}

std::string learner_text(const std::optional<std::string>& refusal) {
    return refusal ? "no: " + *refusal : "yes";
}

std::string characteristics_section(const Characteristics& c, const solvers::Refusals& refusals) {
    TextTable table({{""}, {""}});
    const auto add = [&](const char* what, const std::string& text) {
        std::string title = what;
        for (const std::string& line : wrapped(text, text_width - 16)) {
            table.add_row({title, line});
            title.clear();
        }
    };
    add("transitions", randomness_text(c));
    if (!c.distributions.empty())
        add("distributions", fmt::format("{}", fmt::join(c.distributions, ", ")));
    add("observation", c.partially_observed ? "partially observed" : "fully observed");
    add("state", c.state.text());
    add("actions", actions_text(c));
    add("conditions", fmt::format("{}, {}, {}", counted(c.preconditions, "action-precondition"),
                                  counted(c.invariants, "state-invariant"),
                                  counted(c.terminations, "termination")));
    if (!c.features.empty()) add("language", fmt::format("{}", fmt::join(c.features, ", ")));
    add("train ppo", learner_text(refusals.ppo));
    add("train cgp", learner_text(refusals.cgp));
    add("train drp", learner_text(refusals.drp));
    return '\n' + table.text();
}

}  // namespace

std::string description_text(const ProblemDescription& d) {
    return general_section(d) + characteristics_section(d.characteristics, d.refusals) +
           sizes_section(d) + objects_section(d.model) + fluents_section(d) + policy_section(d);
}

}  // namespace rddlc::workbench
