// Over 400 lines: each part of the file is written and read in one place.
#include "solvers/ppo/policy_file.hpp"

#include "solvers/batches/batch.hpp"
#include "solvers/files/fingerprint.hpp"
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
// Nine digits distinguish a float from its neighbours; "-0" would be the int 0 in JSON, without a
// sign.
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

// A number as JSON has it: nlohmann's library by itself makes 64 of 64.5 and 1 of true.
const Json& number_in(const Json& json, const char* what) {
    if (!json.is_number()) throw Failure(fmt::format("its {} is not a number", what));
    return json;
}
std::int64_t whole_number(const Json& json, const char* what, std::int64_t least,
                          std::int64_t most) {
    const bool is_whole = json.is_number_integer();
    if (is_whole && json >= least && json <= most) return json.get<std::int64_t>();
    throw Failure(fmt::format("its {} is {}, not an int from {} to {}", what, json_excerpt(json),
                              least, most));
}
double real_number(const Json& json, const char* what, double least, double most) {
    const double value = number_in(json, what).get<double>();
    if (value >= least && value <= most) return value;
    throw Failure(
        fmt::format("its {} is {}, not from {:g} to {:g}", what, json_excerpt(json), least, most));
}
std::vector<float> numbers_in(const Json& json, std::size_t count, const char* misfit) {
    if (!json.is_array() || json.size() != count) throw Failure(misfit);
    std::vector<float> numbers;
    numbers.reserve(count);
    for (const Json& each : json) numbers.push_back(number_in(each, "weight").get<float>());
    return numbers;
}
constexpr const char* other_layers = "its layers do not fit";
constexpr int most_units = 1 << 16, most_remembered = 1 << 14;

// Older files hold only the correlation.
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
        R"({{"columns":{},"defaults":{},"reals":{},"categories":{},"max_sub_actions":{},"choices":{},"masked":{}}})",
        array_of(space.names, quoted), array(space.defaults.data(), space.defaults.size()), reals,
        categories, space.max_sub_actions, choices, space.masked);
}

std::string text_of(const ObservationSpace& space) {
    const std::string columns = array_of(space.columns, [](const ObservationSpace::Column& column) {
        return fmt::format(R"({{"name":"{}","objects":{}}})", column.name, column.object_count);
    });
    return fmt::format(R"({{"columns":{},"stack":{},"time":{},"horizon":{}}})", columns,
                       space.stack, space.time, space.horizon);
}

// Files hold weights as [output][input].
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
    if (!json.is_array() || json.size() != static_cast<std::size_t>(outputs))
        throw Failure(other_layers);
    for (int o = 0; o < outputs; ++o) {
        const std::vector<float> of_output = numbers_in(
            json[static_cast<std::size_t>(o)], static_cast<std::size_t>(inputs), other_layers);
        for (int i = 0; i < inputs; ++i) weights(i, o) = of_output[static_cast<std::size_t>(i)];
    }
}
void read_bias(const Json& json, int outputs, float* bias) {
    std::ranges::copy(numbers_in(json, static_cast<std::size_t>(outputs), other_layers), bias);
}

std::string text_of(const Network& network, const float* parameters) {
    return array_of(network.layers, [parameters](const Layer& layer) {
        return fmt::format(R"({{"weights":{},"bias":{}}})",
                           weights_text(layer.weights_in(parameters)),
                           array(parameters + layer.bias, static_cast<std::size_t>(layer.outputs)));
    });
}

void read_layers(const Json& layers, const Network& network, float* parameters) {
    if (layers.size() != network.layers.size()) throw Failure(other_layers);
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

// The size in a file's member "recurrent", checked before anything gets that size.
int units_of(const Json& json) {
    const auto units = whole_number(json.at("units"), "number of units", 1, most_remembered);
    if (json.at("state_bias").size() != static_cast<std::size_t>(units))
        throw Failure(other_layers);
    return static_cast<int>(units);
}

// The same of its hidden layers.
std::vector<int> hidden_of(const Json& json) {
    const Json &sizes = json.at("hidden"), &layers = json.at("policy");
    if (!sizes.is_array() || sizes.empty() || layers.size() != sizes.size() + 1)
        throw Failure(other_layers);
    std::vector<int> hidden;
    for (const Json& size : sizes) {
        const auto units = whole_number(size, "number of units", 1, most_units);
        if (layers.at(hidden.size()).at("bias").size() != static_cast<std::size_t>(units))
            throw Failure(other_layers);
        hidden.push_back(static_cast<int>(units));
    }
    return hidden;
}

// Networks of these sizes have that many weights, each of which takes two bytes of the file or
// more.
void require_weights_in(const PpoModel& model, std::size_t bytes) {
    const auto weights_of = [](const Network& network) {
        double weights = 0;
        for (const Layer& layer : network.layers) weights += 1.0 * layer.inputs * layer.outputs;
        return weights;
    };
    double weights = weights_of(model.policy);
    if (model.solver == "ppo") weights += weights_of(model.value);
    weights += 3.0 * model.memory.units * (model.memory.inputs + model.memory.units);
    if (weights > static_cast<double>(bytes) / 2) throw Failure(other_layers);
}

// The largest that a unit's input can be, where what the unit sees is at most `seen`.
double largest_sum(const Weights<const float>& weights, double seen, int output) {
    double sum = 0;
    for (int i = 0; i < weights.inputs; ++i)
        sum += std::abs(static_cast<double>(weights(i, output))) * seen;
    return sum;
}

// Floats reach to 3.4e38: nothing that the networks compute may come near, whatever is observed.
void require_small(double number) {
    if (!(number < 1e37)) throw Failure("a number in it is too large for a weight");
}
void require_small_sums(const Network& network, const float* parameters) {
    double seen = Normaliser::most;
    for (const Layer& layer : network.layers) {
        double most = 0;
        for (int o = 0; o < layer.outputs; ++o)
            most = std::max(most, largest_sum(layer.weights_in(parameters), seen, o) +
                                      std::abs(static_cast<double>(
                                          parameters[layer.bias + static_cast<std::size_t>(o)])));
        require_small(most);
        seen = network.activation == Activation::Tanh ? 1 : most;
    }
}
void require_small_sums(const Gru& gru, const float* parameters) {
    for (const GruPart& part : gru_parts(gru))
        for (int unit = 0; unit < gru.units; ++unit)
            require_small(
                largest_sum(input_weights(gru, part, parameters), Normaliser::most, unit) +
                largest_sum(state_weights(gru, part, parameters), 1, unit));
}
void require_small_numbers(const PpoModel& model) {
    for (const auto* const all :
         {&model.parameters, &model.normaliser.means, &model.normaliser.factors})
        for (const float number : *all) require_small(std::abs(static_cast<double>(number)));
    require_small_sums(model.policy, model.parameters.data());
    require_small_sums(model.value, model.value_parameters());
    if (model.recurrent > 0) require_small_sums(model.memory, model.memory_parameters());
    // Noise of e^80 is far beyond any action, and still a float.
    for (int d = 0; d < model.deviation_count(); ++d)
        if (model.log_deviations()[d] > 80) throw Failure("its noise is too large");
}

// The observation space without the horizon, which another instance of the problem may have.
Json seen_in(Json space) {
    space.erase("horizon");
    return space;
}

// The action space as this version writes it.
Json acted_in(Json space) {
    if (const auto old = space.find("picks"); old != space.end()) {
        space["max_sub_actions"] = *old;
        space.erase("picks");
    }
    return space;
}

void require_format(const Json& json) {
    const bool is_policy = json.is_object() && json.value("format", "") == "rddl-policy";
    const std::string solver = is_policy ? json.value("solver", "") : "";
    if (solver != "ppo" && solver != "drp") throw Failure("it is not a policy of PPO or DRP");
    const Json& version = json.at("version");
    if (version.is_number_integer() && version > policy_file_version)
        throw Failure(fmt::format("it is of version {}, and this program reads versions up to {}",
                                  json_excerpt(version), policy_file_version));
    whole_number(version, "version", 1, policy_file_version);
}

// Accepts any instance with the same spaces.
void read_spaces(const rddl_simulator& simulator, const Json& json, PpoModel& model) {
    const rddl_problem& problem = *simulator.problem;
    if (json.at("domain") != problem.domain)
        throw Failure(fmt::format(
            "it is of the problem {} ({}), not of {} ({})", json.at("instance").get<std::string>(),
            json.at("domain").get<std::string>(), problem.instance, problem.domain));
    const Json& seen = json.at("observation");
    ObservationOptions options;
    options.stack = static_cast<int>(whole_number(seen.at("stack"), "stack", 1, most_stacked));
    options.time =
        seen.at("time").get<bool>() ? ObservationOptions::Time::On : ObservationOptions::Time::Off;
    model.observations = observation_space(simulator, options);
    model.actions = action_space(simulator);
    for (const Json& real : json.at("action").at("reals"))
        if (real.at("range") == "squashed") squash_bounded(model.actions);
    // Compares values, since other programs lay out JSON in their own way.
    if (seen_in(parse_json(text_of(model.observations))) != seen_in(seen.at("space")) ||
        parse_json(text_of(model.actions)) != acted_in(json.at("action")))
        throw Failure(fmt::format(
            "it was learned in {}, whose observations or actions differ from those of {}",
            json.at("instance").get<std::string>(), problem.instance));
}

// A value of JSON takes about that much once it is read, with what vectors keep in reserve.
constexpr double bytes_per_value = 64;

void require_memory_for(std::string_view text, std::int64_t memory_limit) {
    const auto values = std::ranges::count_if(text, [](char c) { return c == ',' || c == '['; });
    const double bytes =
        static_cast<double>(text.size()) + bytes_per_value * static_cast<double>(values);
    if (bytes > static_cast<double>(memory_limit))
        throw Failure(
            fmt::format("to read it takes about {}, more than the limit of {}", memory_text(bytes),
                        memory_text(static_cast<double>(memory_limit))),
            "a larger --memory-limit allows it");
}

std::shared_ptr<const PpoModel> read(const rddl_simulator& simulator, std::string_view text) {
    const Json json = parse_json(text);
    require_format(json);
    const auto model = std::make_shared<PpoModel>();
    model->solver = json.at("solver").get<std::string>();
    read_spaces(simulator, json, *model);
    model->hidden = hidden_of(json);
    model->activation = activation_of(json);
    if (json.contains("recurrent")) model->recurrent = units_of(json.at("recurrent"));
    model->correlation = real_number(json.at("correlation"), "correlation", 0, 1);
    model->noise = noise_of(json, model->correlation);
    if (json.contains("noise_steps"))
        model->noise_steps = static_cast<int>(whole_number(
            json.at("noise_steps"), "number of steps with the same noise", 1, 1 << 20));
    else
        model->noise_steps = 1;
    const Json& seen = json.at("observation");
    constexpr const char* other_features = "its observations do not fit";
    const auto features = static_cast<std::size_t>(model->features());
    const std::vector<float> means = numbers_in(seen.at("means"), features, other_features);
    const std::vector<float> factors = numbers_in(seen.at("factors"), features, other_features);
    lay_out_networks(*model);
    require_weights_in(*model, text.size());
    make_networks(*model);
    model->normaliser.means = means;
    model->normaliser.factors = factors;
    read_layers(json.at("policy"), model->policy, model->parameters.data());
    if (model->solver == "ppo")
        read_layers(json.at("value"), model->value,
                    model->parameters.data() + model->value_begin());
    if (model->recurrent > 0)
        read_gru(json.at("recurrent"), model->memory,
                 model->parameters.data() + model->memory_begin());
    if (json.contains("values")) {
        if (model->solver != "ppo") throw Failure("only policies of PPO have values");
        const Json& values = json.at("values");
        model->value_scale = real_number(values.at("scale"), "scale of values", 0, 1e30);
        model->value_discount = real_number(values.at("discount"), "discount of values", 0, 1);
    }
    const std::vector<float> deviations =
        numbers_in(json.at("log_deviations"), static_cast<std::size_t>(model->deviation_count()),
                   "its actions do not fit");
    std::copy(deviations.begin(), deviations.end(),
              model->parameters.data() + model->deviations_begin());
    require_small_numbers(*model);
    return model;
}

}  // namespace

std::string ppo_policy_text(const rddl_simulator& simulator, const PpoModel& model) {
    const rddl_problem& problem = *simulator.problem;
    std::string text = fmt::format(
        R"({{"format":"rddl-policy","version":{},"solver":"{}","domain":"{}","instance":"{}",)",
        policy_file_version, model.solver, problem.domain, problem.instance);
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
    text += fmt::format(R"("policy":{},)", text_of(model.policy, model.parameters.data()));
    if (model.solver == "ppo")
        text += fmt::format(R"("value":{},)", text_of(model.value, model.value_parameters()));
    if (model.value_scale > 0)
        text += fmt::format(R"("values":{{"scale":{:.17g},"discount":{:.17g}}},)",
                            model.value_scale, model.value_discount);
    text += fmt::format(
        R"("log_deviations":{},"noise":"{}","noise_steps":{},"correlation":{:.17g}}})",
        array(model.log_deviations(), static_cast<std::size_t>(model.deviation_count())),
        name_of(model.noise), model.noise_steps,
        model.noise == Noise::Ar1 ? model.correlation : 0.0);
    return text + "\n";
}

std::string solver_of_network(std::string_view text) {
    const Json json = Json::parse(text, nullptr, false);
    const bool is_drp = json.is_object() && json.contains("solver") && json["solver"] == "drp";
    return is_drp ? "drp" : "ppo";
}

std::shared_ptr<const PpoModel> read_ppo_policy(const rddl_simulator& simulator,
                                                std::string_view text, std::int64_t memory_limit) {
    require_memory_for(text, memory_limit);
    try {
        return read(simulator, text);
    } catch (const RefusedJson& refused) {
        throw Failure(refused.byte ? "it is incomplete, or not JSON" : refused.what());
    } catch (const nlohmann::json::exception&) {
        throw Failure("it is not a policy of PPO or DRP, or something in it is missing");
    }
}

}  // namespace rddlc::solvers
