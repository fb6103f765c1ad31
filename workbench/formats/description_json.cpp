#include "formats/description.hpp"
#include "formats/records_json.hpp"
#include "model/expression_text.hpp"
#include "support/match.hpp"
#include "vocabulary/vocabulary.hpp"

namespace rddlc::workbench {

namespace {

using Json = nlohmann::ordered_json;

Json source_json(const rddl_source& source) {
    return {{"file", source.file}, {"line", source.line}, {"column", source.column}};
}

Json types_json(const model::Model& model) {
    Json all = Json::array();
    for (const model::Type& type : model.types)
        all.push_back(
            {{"name", type.name}, {"enumerated", type.enumerated}, {"objects", type.objects}});
    return all;
}

Json default_json(const model::Model& model, const model::Fluent& fluent) {
    if (!fluent.default_value) return nullptr;
    if (fluent.range.kind == model::ValueType::Kind::Object)
        return model.types[fluent.range.type]
            .objects[static_cast<std::size_t>(std::get<std::int64_t>(*fluent.default_value))];
    return match(
        *fluent.default_value, [](bool value) { return Json(value); },
        [](std::int64_t value) { return Json(value); },
        [](double value) { return json_number(value); });
}

// null where nothing bounds a value; one number a grounding.
Json bounds_json(const double* bounds, std::int64_t count) {
    if (!bounds) return nullptr;
    Json all = Json::array();
    for (std::int64_t g = 0; g < count; ++g) all.push_back(json_number(bounds[g]));
    return all;
}

Json declaration_json(const model::Model& model, const model::Fluent& fluent) {
    Json parameters = Json::array(), shape = Json::array();
    for (const model::TypeId type : fluent.parameters) {
        parameters.push_back(model.types[type].name);
        shape.push_back(model.types[type].objects.size());
    }
    return {{"name", fluent.name},
            {"role", rddlc::name_of(fluent.role)},
            {"range", model::text_of(model, fluent.range)},
            {"parameters", parameters},
            {"shape", shape},
            {"default", default_json(model, fluent)}};
}

Json fluent_json(const ProblemDescription& d, std::size_t index) {
    const rddl_fluent& described = d.simulator->problem->fluents[index];
    Json fluent = declaration_json(d.model, d.model.fluents[index]);
    fluent["count"] = described.count;
    fluent["offset"] = described.offset < 0 ? Json(nullptr) : Json(described.offset);
    fluent["lower"] = bounds_json(described.lower, described.count);
    fluent["upper"] = bounds_json(described.upper, described.count);
    fluent["source"] = source_json(described.source);
    return fluent;
}

Json policy_json(const ProblemDescription& d) {
    const rddl_policy* const policy = d.simulator->policy;
    if (!policy) return nullptr;
    Json fluents = Json::array();
    for (const model::Fluent& fluent : d.model.policy_fluents())
        fluents.push_back(declaration_json(d.model, fluent));
    return {{"name", policy->name},
            {"source", source_json(policy->source)},
            {"stochastic", policy->stochastic != 0},
            {"memory_size", policy->memory_size},
            {"fluents", fluents}};
}

Json conditions_json(const rddl_condition* conditions, std::int32_t count) {
    Json all = Json::array();
    for (std::int32_t i = 0; i < count; ++i)
        all.push_back(
            {{"text", conditions[i].text}, {"source", source_json(conditions[i].source)}});
    return all;
}

Json values_json(const ValueKinds& kinds, std::int64_t bytes) {
    return {{"values", kinds.total()}, {"bool", kinds.bools}, {"int", kinds.ints},
            {"object", kinds.objects}, {"real", kinds.reals}, {"bytes", bytes}};
}

Json characteristics_json(const Characteristics& c) {
    return {{"stochastic", c.stochastic()},
            {"random_cpfs", c.random_cpfs},
            {"random_reward", c.random_reward},
            {"random_conditions", c.random_conditions},
            {"random_initial_state", c.random_initial_state},
            {"distributions", c.distributions},
            {"partially_observed", c.partially_observed},
            {"state", c.state.text()},
            {"actions", c.action.text()},
            {"concurrent", c.concurrent()},
            {"features", c.features}};
}

Json learner_json(const std::optional<std::string>& refusal) {
    return {{"takes", !refusal}, {"reason", refusal ? Json(*refusal) : Json(nullptr)}};
}

}  // namespace

Json description_json(const ProblemDescription& d) {
    const rddl_problem& problem = *d.simulator->problem;
    const Characteristics& c = d.characteristics;
    Json fluents = Json::array();
    for (std::size_t f = 0; f < d.model.domain_fluents().size(); ++f)
        fluents.push_back(fluent_json(d, f));
    Json sizes{{"state", values_json(c.state, problem.state_size)},
               {"action", values_json(c.action, problem.action_size)},
               {"observation", values_json(c.partially_observed ? c.observation : c.state,
                                           problem.observation_size)}};
    Json files = Json::array();
    for (const auto& path : d.files.all()) files.push_back(path.string());
    return {{"domain", problem.domain},
            {"instance", problem.instance},
            {"files", files},
            {"horizon", problem.horizon},
            {"discount", problem.discount},
            {"max_nondef_actions",
             problem.max_nondef_actions < 0 ? Json(nullptr) : Json(problem.max_nondef_actions)},
            {"action_choices", d.simulator->action_choice_count(d.simulator.get())},
            {"characteristics", characteristics_json(c)},
            {"learners",
             {{"ppo", learner_json(d.refusals.ppo)},
              {"cgp", learner_json(d.refusals.cgp)},
              {"drp", learner_json(d.refusals.drp)}}},
            {"sizes", sizes},
            {"types", types_json(d.model)},
            {"fluents", fluents},
            {"preconditions", conditions_json(problem.preconditions, problem.precondition_count)},
            {"invariants", conditions_json(problem.invariants, problem.invariant_count)},
            {"terminations", conditions_json(problem.terminations, problem.termination_count)},
            {"policy", policy_json(d)}};
}

}  // namespace rddlc::workbench
