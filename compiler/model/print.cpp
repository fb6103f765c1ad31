#include "model/print.hpp"

#include "model/expression_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rddlc::model {
namespace {

constexpr std::size_t values_shown = 8;

std::string header(const Model& model) {
    const std::string limit =
        model.max_nondef_actions ? std::to_string(*model.max_nondef_actions) : "pos-inf";
    return fmt::format("domain {}\ninstance {}\nhorizon {}\ndiscount {}\nmax-nondef-actions {}\n",
                       model.domain_name, model.instance_name, model.horizon,
                       text_of(model, real_type, model.discount), limit);
}

std::string shortened(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < std::min(words.size(), values_shown); ++i)
        text += (i == 0 ? "" : ", ") + words[i];
    if (words.size() > values_shown) text += fmt::format(", ... {} in all", words.size());
    return text;
}

std::string type_line(const Type& type) {
    std::vector<std::string> names;
    for (const std::string& object : type.objects)
        names.push_back((type.enumerated ? "@" : "") + object);
    return fmt::format("    {}: {}{{{}}}\n", type.name, type.enumerated ? "enum " : "",
                       shortened(names));
}

std::int64_t count_of_others(const Table& values, const Value& value) {
    std::int64_t count = 0;
    for (const auto& [index, exception] : values.exceptions()) count += exception != value;
    if (values.common() != value) count += values.size() - std::ssize(values.exceptions());
    return count;
}

// " = 0.5" where all are the same, otherwise the first few.
std::string value_summary(const Model& model, const Fluent& fluent) {
    const Table& values = fluent.values;
    if (values.empty()) return "";
    if (values.is_uniform()) return " = " + text_of(model, fluent.range, values[0]);
    const std::int64_t shown = std::min(values.size(), std::int64_t{values_shown});
    std::string text;
    for (std::int64_t i = 0; i < shown; ++i)
        text += (i == 0 ? "" : ", ") + text_of(model, fluent.range, values[i]);
    if (values.size() > shown) text += fmt::format(", ... {} in all", values.size());
    if (values.size() > shown && fluent.default_value)
        text += fmt::format(", {} not the default", count_of_others(values, *fluent.default_value));
    return fmt::format(" = [{}]", text);
}

std::string fluent_line(const Model& model, const Fluent& fluent) {
    std::string parameters;
    std::string shape;
    for (const TypeId parameter : fluent.parameters) {
        parameters += (parameters.empty() ? "" : ", ") + model.types[parameter].name;
        shape += fmt::format("[{}]", model.types[parameter].objects.size());
    }
    if (!parameters.empty()) parameters = "(" + parameters + ")";
    std::string default_value;
    if (fluent.default_value)
        default_value = " default " + text_of(model, fluent.range, *fluent.default_value);
    return fmt::format("    {} {}{}: {}{}{}{}\n", name_of(fluent.role), fluent.name, parameters,
                       text_of(model, fluent.range), shape, default_value,
                       value_summary(model, fluent));
}

std::string cpf_text(const Model& model, const Cpf& cpf) {
    const Fluent& fluent = model.fluents[cpf.fluent];
    std::string parameters = typed_variable_list(model, cpf.parameters);
    if (!parameters.empty()) parameters = "(" + parameters + ")";
    return fmt::format("    {}{}{}: {} =\n        {}\n", fluent.name,
                       fluent.role == Role::State ? "'" : "", parameters,
                       text_of(model, fluent.range), text_of(model, cpf.body, 8));
}

std::string initial_draws(const Model& model) {
    if (model.initial_draws.empty()) return "";
    std::string text = "\ninit-state\n";
    for (const InitialDraw& draw : model.initial_draws) {
        const Fluent& fluent = model.fluents[draw.fluent];
        std::string objects;
        for (std::size_t i = 0; i < draw.objects.size(); ++i)
            objects +=
                (i == 0 ? "(" : ", ") + model.types[fluent.parameters[i]]
                                            .objects[static_cast<std::size_t>(draw.objects[i])];
        if (!objects.empty()) objects += ")";
        text += fmt::format("    {}{}: {} = {}\n", fluent.name, objects,
                            text_of(model, fluent.range), text_of(model, draw.value, 4));
    }
    return text;
}

std::string conditions(const Model& model, std::string_view title,
                       const std::vector<Expr>& expressions) {
    if (expressions.empty()) return "";
    std::string text = fmt::format("\n{}\n", title);
    for (const Expr& expression : expressions)
        text += fmt::format("    {}\n", text_of(model, expression, 4));
    return text;
}

std::string policy_text(const Model& model, const Policy& policy) {
    std::string text = fmt::format("\npolicy {}\n", policy.name);
    for (const Fluent& fluent : model.policy_fluents()) text += fluent_line(model, fluent);
    text += "\npolicy cpfs\n";
    for (const Cpf& cpf : policy.cpfs) text += cpf_text(model, cpf);
    return text;
}

}  // namespace

std::string print_problem(const Model& model) {
    std::string text = header(model);
    if (!model.types.empty()) text += "\ntypes\n";
    for (const Type& type : model.types) text += type_line(type);
    text += "\nfluents\n";
    for (const Fluent& fluent : model.domain_fluents()) text += fluent_line(model, fluent);
    text += initial_draws(model);
    text += "\ncpfs\n";
    for (const Cpf& cpf : model.cpfs) text += cpf_text(model, cpf);
    text += fmt::format("\nreward\n    {}\n", text_of(model, model.reward, 4));
    text += conditions(model, "action-preconditions", model.action_preconditions);
    text += conditions(model, "state-invariants", model.state_invariants);
    text += conditions(model, "termination", model.terminations);
    return text;
}

std::string print(const Model& model) {
    std::string text = print_problem(model);
    if (model.policy) text += policy_text(model, *model.policy);
    return text;
}

}  // namespace rddlc::model
