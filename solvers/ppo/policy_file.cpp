#include "solvers/ppo/policy_file.hpp"

#include "support/failure.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace rddlc::solvers {

namespace {

using Json = nlohmann::ordered_json;

// JSON knows no infinity: null stands for it.
Json bound(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

const char* name_of(RealHead::Range range) {
    switch (range) {
        case RealHead::Range::Bounded:
            return "bounded";
        case RealHead::Range::AboveLower:
            return "above lower";
        case RealHead::Range::BelowUpper:
            return "below upper";
        case RealHead::Range::Free:
            break;
    }
    return "free";
}

Json to_json(const ActionSpace& space) {
    Json reals = Json::array(), categories = Json::array(), choices = Json::array();
    for (const RealHead& head : space.reals)
        reals.push_back({{"column", head.column},
                         {"range", name_of(head.range)},
                         {"lower", bound(head.lower)},
                         {"upper", bound(head.upper)},
                         {"scale", head.scale},
                         {"centre", head.centre},
                         {"rounds", head.rounds}});
    for (const CategoryHead& head : space.categories)
        categories.push_back({{"column", head.column},
                              {"first_logit", head.first_logit},
                              {"count", head.count},
                              {"first_value", head.first_value}});
    for (const Choice& choice : space.choices)
        choices.push_back(
            {{"column", choice.column}, {"value", choice.value}, {"real", choice.real}});
    return {{"columns", space.names},   {"defaults", space.defaults}, {"reals", reals},
            {"categories", categories}, {"picks", space.picks},       {"choices", choices},
            {"masked", space.masked}};
}

Json to_json(const ObservationSpace& space) {
    Json columns = Json::array();
    for (const ObservationSpace::Column& column : space.columns)
        columns.push_back({{"name", column.name}, {"objects", column.object_count}});
    return {{"columns", columns},
            {"stack", space.stack},
            {"time", space.time},
            {"horizon", space.horizon}};
}

Json layers_to_json(const Network& network, const float* parameters) {
    Json layers = Json::array();
    for (const Layer& layer : network.layers) {
        Json weights = Json::array();
        for (int o = 0; o < layer.outputs; ++o) {
            Json row = Json::array();
            for (int i = 0; i < layer.inputs; ++i)
                row.push_back(parameters[layer.weights +
                                         static_cast<std::size_t>(i * layer.padded_outputs + o)]);
            weights.push_back(std::move(row));
        }
        const float* const bias = parameters + layer.bias;
        layers.push_back(
            {{"weights", weights}, {"bias", std::vector<float>(bias, bias + layer.outputs)}});
    }
    return layers;
}

void read_layers(const Json& layers, const Network& network, float* parameters) {
    if (layers.size() != network.layers.size()) throw Failure("its layers do not fit");
    for (std::size_t l = 0; l < layers.size(); ++l) {
        const Layer& layer = network.layers[l];
        const auto weights = layers[l].at("weights").get<std::vector<std::vector<float>>>();
        const auto bias = layers[l].at("bias").get<std::vector<float>>();
        bool fits = weights.size() == static_cast<std::size_t>(layer.outputs) &&
                    bias.size() == weights.size();
        for (const auto& row : weights)
            fits &= row.size() == static_cast<std::size_t>(layer.inputs);
        if (!fits) throw Failure("its layers do not fit");
        for (int o = 0; o < layer.outputs; ++o) {
            const auto at = static_cast<std::size_t>(o);
            for (int i = 0; i < layer.inputs; ++i)
                parameters[layer.weights + static_cast<std::size_t>(i * layer.padded_outputs + o)] =
                    weights[at][static_cast<std::size_t>(i)];
            parameters[layer.bias + at] = bias[at];
        }
    }
}

std::shared_ptr<const PpoModel> read(const rddl_simulator& simulator, std::string_view text) {
    const Json json = Json::parse(text);
    if (json.value("format", "") != "rddl-policy" || json.value("solver", "") != "ppo")
        throw Failure("it is no policy of PPO");
    const int version = json.at("version").get<int>();
    if (version > policy_file_version)
        throw Failure(fmt::format("it is of version {}, and this program reads versions up to {}",
                                  version, policy_file_version));
    const rddl_problem& problem = *simulator.problem;
    if (json.at("domain") != problem.domain || json.at("instance") != problem.instance)
        throw Failure(fmt::format(
            "it is of the problem {} ({}), not of {} ({})", json.at("instance").get<std::string>(),
            json.at("domain").get<std::string>(), problem.instance, problem.domain));
    const auto model = std::make_shared<PpoModel>();
    const Json& seen = json.at("observation");
    ObservationOptions options;
    options.stack = seen.at("stack").get<int>();
    options.time =
        seen.at("time").get<bool>() ? ObservationOptions::Time::On : ObservationOptions::Time::Off;
    model->observations = observation_space(simulator, options);
    model->actions = action_space(simulator);
    if (to_json(model->observations) != seen.at("space") ||
        to_json(model->actions) != json.at("action"))
        throw Failure("it is of another version of the problem: what is seen or done has changed");
    model->hidden = json.at("hidden").get<std::vector<int>>();
    make_networks(*model);
    model->normaliser.means = seen.at("means").get<std::vector<float>>();
    model->normaliser.factors = seen.at("factors").get<std::vector<float>>();
    if (model->normaliser.means.size() != static_cast<std::size_t>(model->features()) ||
        model->normaliser.factors.size() != model->normaliser.means.size())
        throw Failure("its observations do not fit");
    read_layers(json.at("policy"), model->policy, model->parameters.data());
    read_layers(json.at("value"), model->value, model->parameters.data() + model->value_begin());
    const auto deviations = json.at("log_deviations").get<std::vector<float>>();
    if (deviations.size() != model->actions.reals.size()) throw Failure("its actions do not fit");
    std::copy(deviations.begin(), deviations.end(),
              model->parameters.data() + model->deviations_begin());
    model->correlation = json.at("correlation").get<double>();
    model->noise = model->correlation > 0 ? Noise::Ar1 : Noise::White;
    return model;
}

struct PpoActor {
    PpoActor(const rddl_simulator& its_simulator, std::shared_ptr<const PpoModel> its_model,
             bool its_random, std::uint64_t its_seed, std::int64_t environments)
        : simulator(its_simulator),
          model(std::move(its_model)),
          random(its_random),
          seed(its_seed),
          records(simulator),
          chooser(simulator, model->actions, model->noise, model->correlation, environments) {
        const auto count = static_cast<std::size_t>(environments);
        const auto rows = [&](int row) {
            return count * static_cast<std::size_t>(row);
        };
        observations.resize(rows(model->observations.column_count()));
        features.resize(rows(model->features()));
        normalised.resize(features.size());
        outputs.resize(rows(model->policy.padded_outputs()));
        activations.resize(tile * model->policy.activations);
        numbers.resize(rows(model->actions.real_count()));
        shifts.resize(numbers.size());
        spreads.resize(count);
        log_probabilities.resize(count);
        indices.resize(rows(model->actions.index_count()));
        masks.resize(rows(model->actions.mask_size()));
        actions.resize(rows(model->actions.column_count));
    }

    void act(Decision& decision) {
        const std::int64_t count = static_cast<std::int64_t>(decision.running.size());
        const int width = model->features(), output_row = model->policy.padded_outputs();
        simulator.get_observation_values(decision.batch, RDDL_FLOAT, observations.data());
        for (std::int64_t e = 0; e < count; ++e) {
            const std::int64_t steps = decision.steps[static_cast<std::size_t>(e)];
            write_features(model->observations,
                           observations.data() + e * model->observations.column_count(), steps,
                           steps == 0, features.data() + e * width);
            model->normaliser.write(features.data() + e * width, normalised.data() + e * width);
            if (steps == 0) chooser.begin_episode(e);
        }
        for (std::int64_t e = 0; e < count; e += tile) {
            const int some = static_cast<int>(std::min<std::int64_t>(tile, count - e));
            network_functions().forward(model->policy, model->parameters.data(), some,
                                        normalised.data() + e * width, width, activations.data());
            std::copy_n(activations.data() +
                            model->policy.layers.back().values * static_cast<std::size_t>(some),
                        some * output_row, outputs.data() + e * output_row);
        }
        const Chosen chosen{numbers.data(), shifts.data(), spreads.data(),
                            indices.data(), masks.data(),  log_probabilities.data()};
        const auto key_of = [&](std::int64_t e) {
            const auto at = static_cast<std::size_t>(e);
            return ChoiceKey{seed, static_cast<std::uint64_t>(decision.episodes[at]),
                             static_cast<std::uint64_t>(decision.steps[at])};
        };
        chooser.choose(decision.batch, outputs.data(), output_row,
                       random ? model->log_deviations() : nullptr, key_of, chosen, actions.data());
        for (std::int64_t e = 0; e < count; ++e)
            records.write(actions.data() + e * model->actions.column_count,
                          decision.actions + static_cast<std::size_t>(e) * records.record_size());
    }

    const rddl_simulator& simulator;
    std::shared_ptr<const PpoModel> model;
    bool random;
    std::uint64_t seed;
    ActionRecords records;
    Chooser chooser;
    std::vector<float> observations, features, normalised, outputs, activations, numbers, shifts,
        spreads, log_probabilities, actions;
    std::vector<std::int32_t> indices;
    std::vector<std::uint8_t> masks;
};

}  // namespace

std::string ppo_policy_text(const rddl_simulator& simulator, const PpoModel& model) {
    const rddl_problem& problem = *simulator.problem;
    const std::vector<float> deviations(model.log_deviations(),
                                        model.log_deviations() + model.actions.real_count());
    const Json json{{"format", "rddl-policy"},
                    {"version", policy_file_version},
                    {"solver", "ppo"},
                    {"domain", problem.domain},
                    {"instance", problem.instance},
                    {"observation",
                     {{"space", to_json(model.observations)},
                      {"stack", model.observations.stack},
                      {"time", model.observations.time},
                      {"means", model.normaliser.means},
                      {"factors", model.normaliser.factors}}},
                    {"action", to_json(model.actions)},
                    {"hidden", model.hidden},
                    {"policy", layers_to_json(model.policy, model.parameters.data())},
                    {"value", layers_to_json(model.value, model.value_parameters())},
                    {"log_deviations", deviations},
                    {"correlation", model.noise == Noise::Ar1 ? model.correlation : 0.0}};
    return json.dump() + "\n";
}

std::shared_ptr<const PpoModel> read_ppo_policy(const rddl_simulator& simulator,
                                                std::string_view text) {
    try {
        return read(simulator, text);
    } catch (const nlohmann::json::parse_error&) {
        throw Failure("it is not complete, or no JSON");
    } catch (const nlohmann::json::exception&) {
        throw Failure("it is no policy of PPO, or something in it is missing");
    }
}

Policy ppo_policy(const rddl_simulator& simulator, std::shared_ptr<const PpoModel> model,
                  bool random, std::uint64_t seed, std::string name) {
    return {std::move(name), [&simulator, model, random, seed](std::int64_t environments) -> Actor {
                const auto actor =
                    std::make_shared<PpoActor>(simulator, model, random, seed, environments);
                return [actor](Decision& decision) {
                    actor->act(decision);
                };
            }};
}

}  // namespace rddlc::solvers
