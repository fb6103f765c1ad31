#include "solvers/ppo/policy_file.hpp"

#include "solvers/batches/batch.hpp"
#include "solvers/ppo/memories.hpp"
#include "solvers/ppo/state_noise.hpp"
#include "support/failure.hpp"
#include "support/json_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace rddlc::solvers {

namespace {

using Json = nlohmann::json;

// JSON as text. Names are those of RDDL: nothing in them needs an escape.
std::string quoted(const std::string& name) {
    return "\"" + name + "\"";
}
// Nine digits tell a float from its neighbours; "-0" would be the int 0 in JSON, without a sign.
std::string array(const float* values, std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i)
        text += fmt::format("{}{:.9g}{}", i > 0 ? "," : "", values[i],
                            values[i] == 0 && std::signbit(values[i]) ? ".0" : "");
    return "[" + text + "]";
}
template <class Values, class Text>
std::string array_of(const Values& values, Text text_of) {
    std::string text;
    for (const auto& value : values) text += (text.empty() ? "" : ",") + text_of(value);
    return "[" + text + "]";
}
// JSON knows no infinity: null stands for it.
std::string bound(double value) {
    return std::isfinite(value) ? fmt::format("{:.17g}", value) : "null";
}

const char* name_of(RealHead::Range range) {
    switch (range) {
        case RealHead::Range::Bounded:
            return "bounded";
        case RealHead::Range::Squashed:
            return "squashed";
        case RealHead::Range::AboveLower:
            return "above lower";
        case RealHead::Range::BelowUpper:
            return "below upper";
        case RealHead::Range::Free:
            break;
    }
    return "free";
}

// Older files tell the correlation alone.
Noise noise_of(const Json& json, double correlation) {
    const std::string name = json.value("noise", correlation > 0 ? "ar1" : "white");
    for (const Noise noise : {Noise::White, Noise::Ar1, Noise::Sde})
        if (name == name_of(noise)) return noise;
    throw Failure("its noise is unknown: '" + name + "'");
}
// Files without one are of tanh.
Activation activation_of(const Json& json) {
    const std::string name = json.value("activation", name_of(Activation::Tanh));
    if (const auto known = activation_named(name)) return *known;
    throw Failure("its activation is unknown: '" + name + "'");
}

int version_of(const PpoModel& model) {
    for (const CategoryHead& head : model.actions.categories)
        if (!head.group.empty()) return 4;
    if (model.activation != Activation::Tanh) return 3;
    return model.recurrent > 0 ? 2 : 1;
}

std::string text_of(const ActionSpace& space) {
    const std::string reals = array_of(space.reals, [](const RealHead& head) {
        return fmt::format(
            R"({{"column":{},"range":"{}","lower":{},"upper":{},"scale":{:.17g},"centre":{:.17g},"rounds":{}}})",
            head.column, name_of(head.range), bound(head.lower), bound(head.upper), head.scale,
            head.centre, head.rounds);
    });
    const std::string categories = array_of(space.categories, [](const CategoryHead& head) {
        const std::string group =
            head.group.empty()
                ? ""
                : R"(,"group":)" + array_of(head.group, [](int c) { return std::to_string(c); });
        return fmt::format(R"({{"column":{},"first_logit":{},"count":{},"first_value":{}{}}})",
                           head.column, head.first_logit, head.count, head.first_value, group);
    });
    const std::string choices = array_of(space.choices, [](const Choice& choice) {
        return fmt::format(R"({{"column":{},"value":{},"real":{}}})", choice.column, choice.value,
                           choice.real);
    });
    return fmt::format(
        R"({{"columns":{},"defaults":{},"reals":{},"categories":{},"picks":{},"choices":{},"masked":{}}})",
        array_of(space.names, quoted), array(space.defaults.data(), space.defaults.size()), reals,
        categories, space.picks, choices, space.masked);
}

std::string text_of(const ObservationSpace& space) {
    const std::string columns = array_of(space.columns, [](const ObservationSpace::Column& column) {
        return fmt::format(R"({{"name":"{}","objects":{}}})", column.name, column.object_count);
    });
    return fmt::format(R"({{"columns":{},"stack":{},"time":{},"horizon":{}}})", columns,
                       space.stack, space.time, space.horizon);
}

// In files [output][input].
std::string weights_text(const Weights<const float>& weights) {
    std::string text;
    std::vector<float> of_output(static_cast<std::size_t>(weights.inputs));
    for (int o = 0; o < weights.outputs; ++o) {
        for (int i = 0; i < weights.inputs; ++i)
            of_output[static_cast<std::size_t>(i)] = weights(i, o);
        text += (o > 0 ? "," : "") + array(of_output.data(), of_output.size());
    }
    return "[" + text + "]";
}
void read_weights(const Json& json, const Weights<float>& weights) {
    const int inputs = weights.inputs, outputs = weights.outputs;
    const auto all = json.get<std::vector<std::vector<float>>>();
    if (all.size() != static_cast<std::size_t>(outputs)) throw Failure("its layers do not fit");
    for (int o = 0; o < outputs; ++o) {
        const std::vector<float>& of_output = all[static_cast<std::size_t>(o)];
        if (of_output.size() != static_cast<std::size_t>(inputs))
            throw Failure("its layers do not fit");
        for (int i = 0; i < inputs; ++i) weights(i, o) = of_output[static_cast<std::size_t>(i)];
    }
}
void read_bias(const Json& json, int outputs, float* bias) {
    const auto all = json.get<std::vector<float>>();
    if (all.size() != static_cast<std::size_t>(outputs)) throw Failure("its layers do not fit");
    std::ranges::copy(all, bias);
}

std::string text_of(const Network& network, const float* parameters) {
    return array_of(network.layers, [parameters](const Layer& layer) {
        return fmt::format(R"({{"weights":{},"bias":{}}})",
                           weights_text(layer.weights_in(parameters)),
                           array(parameters + layer.bias, static_cast<std::size_t>(layer.outputs)));
    });
}

void read_layers(const Json& layers, const Network& network, float* parameters) {
    if (layers.size() != network.layers.size()) throw Failure("its layers do not fit");
    for (std::size_t l = 0; l < layers.size(); ++l) {
        const Layer& layer = network.layers[l];
        read_weights(layers[l].at("weights"), layer.weights_in(parameters));
        read_bias(layers[l].at("bias"), layer.outputs, parameters + layer.bias);
    }
}

std::string text_of(const Gru& gru, const float* parameters) {
    const auto units = static_cast<std::size_t>(gru.units);
    std::string text = fmt::format(R"({{"units":{})", gru.units);
    for (const GruPart& part : gru_parts(gru))
        text += fmt::format(R"(,"{}":{{"input":{},"state":{},"bias":{}}})", part.name,
                            weights_text(input_weights(gru, part, parameters)),
                            weights_text(state_weights(gru, part, parameters)),
                            array(parameters + part.bias, units));
    return text + fmt::format(R"(,"state_bias":{}}})", array(parameters + gru.state_bias(), units));
}

void read_gru(const Json& json, const Gru& gru, float* parameters) {
    for (const GruPart& part : gru_parts(gru)) {
        const Json& its = json.at(part.name);
        read_weights(its.at("input"), input_weights(gru, part, parameters));
        read_weights(its.at("state"), state_weights(gru, part, parameters));
        read_bias(its.at("bias"), gru.units, parameters + part.bias);
    }
    read_bias(json.at("state_bias"), gru.units, parameters + gru.state_bias());
}

// Of a file's member "recurrent", before anything gets that size.
int units_of(const Json& json) {
    const int units = json.at("units").get<int>();
    if (units < 1 || json.at("state_bias").size() != static_cast<std::size_t>(units))
        throw Failure("its layers do not fit");
    return units;
}

// The same of its hidden layers.
std::vector<int> hidden_of(const Json& json) {
    const auto hidden = json.at("hidden").get<std::vector<int>>();
    const Json& layers = json.at("policy");
    if (hidden.empty() || layers.size() != hidden.size() + 1)
        throw Failure("its layers do not fit");
    for (std::size_t l = 0; l < hidden.size(); ++l)
        if (hidden[l] < 1 || layers.at(l).at("bias").size() != static_cast<std::size_t>(hidden[l]))
            throw Failure("its layers do not fit");
    return hidden;
}

std::shared_ptr<const PpoModel> read(const rddl_simulator& simulator, std::string_view text) {
    const Json json = parse_json(text);
    if (json.value("format", "") != "rddl-policy" || json.value("solver", "") != "ppo")
        throw Failure("it is no policy of PPO");
    const int version = json.at("version").get<int>();
    if (version < 1 || version > policy_file_version)
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
    for (const Json& real : json.at("action").at("reals"))
        if (real.at("range") == "squashed") squash_bounded(model->actions);
    // As values: other programs lay out JSON in their own way.
    if (parse_json(text_of(model->observations)) != seen.at("space") ||
        parse_json(text_of(model->actions)) != json.at("action"))
        throw Failure("it is of another version of the problem: what is seen or done has changed");
    model->hidden = hidden_of(json);
    model->activation = activation_of(json);
    if (json.contains("recurrent")) model->recurrent = units_of(json.at("recurrent"));
    model->correlation = json.at("correlation").get<double>();
    model->noise = noise_of(json, model->correlation);
    model->noise_steps = std::max(json.value("noise_steps", 1), 1);
    make_networks(*model);
    model->normaliser.means = seen.at("means").get<std::vector<float>>();
    model->normaliser.factors = seen.at("factors").get<std::vector<float>>();
    if (model->normaliser.means.size() != static_cast<std::size_t>(model->features()) ||
        model->normaliser.factors.size() != model->normaliser.means.size())
        throw Failure("its observations do not fit");
    read_layers(json.at("policy"), model->policy, model->parameters.data());
    read_layers(json.at("value"), model->value, model->parameters.data() + model->value_begin());
    if (model->recurrent > 0)
        read_gru(json.at("recurrent"), model->memory,
                 model->parameters.data() + model->memory_begin());
    const auto deviations = json.at("log_deviations").get<std::vector<float>>();
    if (deviations.size() != static_cast<std::size_t>(model->deviation_count()))
        throw Failure("its actions do not fit");
    std::copy(deviations.begin(), deviations.end(),
              model->parameters.data() + model->deviations_begin());
    const auto is_finite = [](float number) {
        return std::isfinite(number);
    };
    if (!std::ranges::all_of(model->parameters, is_finite) ||
        !std::ranges::all_of(model->normaliser.means, is_finite) ||
        !std::ranges::all_of(model->normaliser.factors, is_finite))
        throw Failure("a number in it is too large for a weight");
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
          chooser(simulator, model->actions, model->noise, model->correlation, environments),
          state_noise(*model, environments),
          memories(*model, environments) {
        if (state_noise.is_used()) state_noise.look_at_policy();
        const auto count = static_cast<std::size_t>(environments);
        const auto rows = [&](int row) {
            return count * static_cast<std::size_t>(row);
        };
        observations.resize(rows(model->observations.column_count()));
        features.resize(rows(model->features()));
        inputs.resize(rows(model->input_row()));
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
        const int width = model->features(), row = model->input_row();
        const int output_row = model->policy.padded_outputs();
        require_done(simulator, simulator.get_observation_values(decision.batch, RDDL_FLOAT,
                                                                 observations.data()));
        for (std::int64_t e = 0; e < count; ++e) {
            const std::int64_t steps = decision.steps[static_cast<std::size_t>(e)];
            write_features(model->observations,
                           observations.data() + e * model->observations.column_count(), steps,
                           steps == 0, features.data() + e * width);
            model->normaliser.write(features.data() + e * width, inputs.data() + e * row);
            if (steps > 0) continue;
            chooser.begin_episode(e);
            state_noise.begin_episode(e);
            memories.begin_episode(e);
        }
        const auto key_of = [&](std::int64_t e) {
            const auto at = static_cast<std::size_t>(e);
            return ChoiceKey{seed, static_cast<std::uint64_t>(decision.episodes[at]),
                             static_cast<std::uint64_t>(decision.steps[at])};
        };
        for (std::int64_t e = 0; e < count; e += tile) {
            const int some = static_cast<int>(std::min<std::int64_t>(tile, count - e));
            memories.remember(e, some, inputs.data() + e * row);
            network_functions().forward(model->policy, model->parameters.data(), some,
                                        inputs.data() + e * row, row, activations.data());
            std::copy_n(activations.data() +
                            model->policy.layers.back().values * static_cast<std::size_t>(some),
                        some * output_row, outputs.data() + e * output_row);
            for (int i = 0; i < some && random && state_noise.is_used(); ++i)
                state_noise.make(e + i,
                                 last_hidden(model->policy, activations.data(), some) +
                                     i * hidden_row(model->policy),
                                 key_of(e + i));
        }
        const Chosen chosen{numbers.data(), shifts.data(), spreads.data(),
                            indices.data(), masks.data(),  log_probabilities.data()};
        chooser.choose(decision.batch, outputs.data(), output_row,
                       !random                 ? Deviations{}
                       : state_noise.is_used() ? state_noise.deviations()
                                               : Deviations{model->log_deviations()},
                       key_of, chosen, actions.data());
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
    StateNoise state_noise;
    Memories memories;
    std::vector<float> observations, features, inputs, outputs, activations, numbers, shifts,
        spreads, log_probabilities, actions;
    std::vector<std::int32_t> indices;
    std::vector<std::uint8_t> masks;
};

}  // namespace

std::string ppo_policy_text(const rddl_simulator& simulator, const PpoModel& model) {
    const rddl_problem& problem = *simulator.problem;
    std::string text = fmt::format(
        R"({{"format":"rddl-policy","version":{},"solver":"ppo","domain":"{}","instance":"{}",)",
        version_of(model), problem.domain, problem.instance);
    text +=
        fmt::format(R"("observation":{{"space":{},"stack":{},"time":{},"means":{},"factors":{}}},)",
                    text_of(model.observations), model.observations.stack, model.observations.time,
                    array(model.normaliser.means.data(), model.normaliser.means.size()),
                    array(model.normaliser.factors.data(), model.normaliser.factors.size()));
    text += fmt::format(R"("action":{},"hidden":{},)", text_of(model.actions),
                        array_of(model.hidden, [](int units) { return std::to_string(units); }));
    if (model.activation != Activation::Tanh)
        text += fmt::format(R"("activation":"{}",)", name_of(model.activation));
    if (model.recurrent > 0)
        text += fmt::format(R"("recurrent":{},)", text_of(model.memory, model.memory_parameters()));
    text +=
        fmt::format(R"("policy":{},"value":{},)", text_of(model.policy, model.parameters.data()),
                    text_of(model.value, model.value_parameters()));
    text += fmt::format(
        R"("log_deviations":{},"noise":"{}","noise_steps":{},"correlation":{:.17g}}})",
        array(model.log_deviations(), static_cast<std::size_t>(model.deviation_count())),
        name_of(model.noise), model.noise_steps,
        model.noise == Noise::Ar1 ? model.correlation : 0.0);
    return text + "\n";
}

std::shared_ptr<const PpoModel> read_ppo_policy(const rddl_simulator& simulator,
                                                std::string_view text) {
    try {
        return read(simulator, text);
    } catch (const RefusedJson& refused) {
        throw Failure(refused.byte ? "it is not complete, or no JSON" : refused.what());
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
