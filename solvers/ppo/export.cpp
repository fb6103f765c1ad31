#include "solvers/ppo/export.hpp"

#include "solvers/files/protocol_buffers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace rddlc::solvers {

namespace {

std::string array_text(const std::string& name, const std::vector<float>& values) {
    std::string text = fmt::format("inline constexpr float {}[] = {{", name);
    for (std::size_t i = 0; i < values.size(); ++i)
        text += fmt::format("{}{:.9g}f", i % 8 == 0 ? "\n    " : " ", values[i]) +
                (i + 1 < values.size() ? "," : "");
    // A number without a point is not a float.
    return text + "};\n";
}

// Outputs times inputs, row by row.
std::vector<float> rows_of(const Weights<const float>& weights) {
    std::vector<float> rows;
    for (int o = 0; o < weights.outputs; ++o)
        for (int i = 0; i < weights.inputs; ++i) rows.push_back(weights(i, o));
    return rows;
}
std::vector<float> weights_of(const Layer& layer, const float* parameters) {
    return rows_of(layer.weights_in(parameters));
}
std::vector<float> bias_of(const Layer& layer, const float* parameters) {
    const float* const bias = parameters + layer.bias;
    return {bias, bias + layer.outputs};
}

// "1f" is not valid C++.
std::string with_points(std::string text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool ends =
            text[i] == 'f' && i > 0 && std::isdigit(static_cast<unsigned char>(text[i - 1]));
        if (ends) {
            std::size_t begin = i;
            while (begin > 0 &&
                   (std::isalnum(static_cast<unsigned char>(text[begin - 1])) ||
                    text[begin - 1] == '.' || text[begin - 1] == '-' || text[begin - 1] == '+'))
                --begin;
            const std::string number = text.substr(begin, i - begin);
            if (number.find_first_of(".e") == std::string::npos) result += ".0";
        }
        result += text[i];
    }
    return result;
}

// Weights and bias of what remembers, in the order of `order` (indices of gru_parts), as ONNX has
// them: W and R [part][unit][input], and the biases of both.
struct GruArrays {
    std::vector<float> input, state, bias;
};
GruArrays arrays_of(const PpoModel& model, const std::array<int, 3>& order) {
    const Gru& gru = model.memory;
    const float* const parameters = model.memory_parameters();
    const auto parts = gru_parts(gru);
    GruArrays arrays;
    const auto append = [](std::vector<float>& to, const std::vector<float>& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    for (const int p : order) {
        const GruPart& part = parts[static_cast<std::size_t>(p)];
        append(arrays.input, rows_of(input_weights(gru, part, parameters)));
        append(arrays.state, rows_of(state_weights(gru, part, parameters)));
        append(arrays.bias, {parameters + part.bias, parameters + part.bias + gru.units});
    }
    // Only the candidate has a second bias, for the state that it reads.
    const float* const read = parameters + gru.state_bias();
    for (const int p : order)
        append(arrays.bias, p == 0 ? std::vector<float>(read, read + gru.units)
                                   : std::vector<float>(static_cast<std::size_t>(gru.units)));
    return arrays;
}

// Holds 1 for each output that ends with tanh, else 0.
std::vector<float> squashed_outputs(const PpoModel& model) {
    std::vector<float> squashed(static_cast<std::size_t>(model.policy.outputs()));
    for (std::size_t r = 0; r < model.actions.reals.size(); ++r)
        squashed[r] = model.actions.reals[r].range == RealHead::Range::Squashed;
    return squashed;
}

// ------------------------------------------------------------------------------------- C++

const char* activation_cpp(Activation activation) {
    return activation == Activation::Relu ? "(sum > 0 ? sum : 0)" : "std::tanh(sum)";
}

std::string memory_arrays_cpp(const PpoModel& model) {
    const GruArrays arrays = arrays_of(model, {0, 1, 2});
    return fmt::format(
               "// What is remembered of the episode: zeros before its first step.\n"
               "constexpr int memory_count = {};\n\n"
               "// Of the candidate, of reset and of update: a row for each unit.\n",
               model.recurrent) +
           with_points(array_text("memory_input", arrays.input)) +
           with_points(array_text("memory_state", arrays.state)) +
           "// And then of what the candidate reads of the state.\n" +
           with_points(array_text(
               "memory_bias", {arrays.bias.begin(), arrays.bias.begin() + 4 * model.recurrent}));
}

constexpr const char* remember_cpp = R"(// K. Cho et al., 2014: gated recurrent units.
inline void remember(const float* x, float* memory) {
    float next[memory_count];
    for (int u = 0; u < memory_count; ++u) {
        float part[4];
        for (int p = 0; p < 4; ++p) part[p] = memory_bias[p * memory_count + u];
        for (int p = 0; p < 3; ++p) {
            const int row = p * memory_count + u;
            for (int i = 0; i < feature_count; ++i) part[p] += memory_input[row * feature_count + i] * x[i];
            float& sum = part[p == 0 ? 3 : p];
            for (int i = 0; i < memory_count; ++i) sum += memory_state[row * memory_count + i] * memory[i];
        }
        const float reset = 1 / (1 + std::exp(-part[1])), update = 1 / (1 + std::exp(-part[2]));
        const float candidate = std::tanh(part[0] + reset * part[3]);
        next[u] = candidate + update * (memory[u] - candidate);
    }
    for (int u = 0; u < memory_count; ++u) memory[u] = next[u];
}

)";

// ------------------------------------------------------------------------------------ ONNX

// Numbers of fields in onnx.proto.
std::string tensor(const std::string& name, const std::vector<std::int64_t>& shape,
                   const std::vector<float>& values) {
    std::string out;
    for (const std::int64_t size : shape) append_number(out, 1, static_cast<std::uint64_t>(size));
    append_number(out, 2, 1);  // FLOAT
    append_bytes(out, 8, name);
    std::string raw;
    for (const float value : values)
        append_little_endian(raw, std::bit_cast<std::uint32_t>(value), 4);
    append_bytes(out, 9, raw);
    return out;
}

struct Attribute {
    const char* name;
    int value;
};
std::string node(const std::string& operation, const std::vector<std::string>& inputs,
                 const std::vector<std::string>& outputs,
                 const std::vector<Attribute>& attributes = {}) {
    std::string out;
    for (const std::string& input : inputs) append_bytes(out, 1, input);
    for (const std::string& output : outputs) append_bytes(out, 2, output);
    append_bytes(out, 4, operation);
    for (const Attribute& each : attributes) {
        std::string attribute;
        append_bytes(attribute, 1, each.name);
        append_number(attribute, 3, static_cast<std::uint64_t>(each.value));
        append_number(attribute, 20, 2);  // INT
        append_bytes(out, 5, attribute);
    }
    return out;
}

// A tensor of 64-bit ints: the axes of dimensions of 1.
std::string axes_tensor(const std::string& name, std::int64_t axis) {
    std::string out, raw;
    append_number(out, 1, 1);
    append_number(out, 2, 7);  // INT64
    append_bytes(out, 8, name);
    append_little_endian(raw, static_cast<std::uint64_t>(axis), 8);
    append_bytes(out, 9, raw);
    return out;
}

std::string value_info(const std::string& name, int columns) {
    std::string batch, width, shape, type, info, outer;
    append_bytes(batch, 2, "batch");
    append_number(width, 1, static_cast<std::uint64_t>(columns));
    append_bytes(shape, 1, batch);
    append_bytes(shape, 1, width);
    append_number(type, 1, 1);  // FLOAT
    append_bytes(type, 2, shape);
    append_bytes(outer, 1, type);
    append_bytes(info, 1, name);
    append_bytes(info, 2, outer);
    return info;
}

std::string outputs_comment(const CategoryHead& head, const std::vector<std::string>& names) {
    const auto name = [&](int column) {
        return names[static_cast<std::size_t>(column)];
    };
    if (head.group.empty())
        return fmt::format("\n//   {}: logits of {} values", name(head.column), head.count);
    return fmt::format("\n//   {}{} to {}: logits of which one changes",
                       head.first_value == 0 ? "none, or one of " : "", name(head.group.front()),
                       name(head.group.back()));
}

}  // namespace

std::string ppo_policy_cpp(const PpoModel& model) {
    const Network& network = model.policy;
    std::string text = fmt::format(
        "// A policy that rddl train {} has learned; rddl export wrote it.\n"
        "// Features:",
        model.solver);
    for (int k = 0; k < model.observations.stack; ++k)
        for (const std::string& feature : model.observations.features)
            text += fmt::format("\n//   {}{}", feature,
                                k == 0   ? ""
                                : k == 1 ? ", 1 step ago"
                                         : fmt::format(", {} steps ago", k));
    if (model.observations.time) text += "\n//   steps made / horizon";
    text += "\n// Outputs:";
    for (const RealHead& head : model.actions.reals)
        text += fmt::format("\n//   {}: a number in the learner's scale",
                            model.actions.names[static_cast<std::size_t>(head.column)]);
    for (const CategoryHead& head : model.actions.categories)
        text += outputs_comment(head, model.actions.names);
    for (const Choice& choice : model.actions.choices)
        text += choice.column < 0
                    ? "\n//   logit of stopping"
                    : fmt::format("\n//   logit of {} = {}",
                                  model.actions.names[static_cast<std::size_t>(choice.column)],
                                  choice.value);
    text += fmt::format(
        "\n#pragma once\n\n#include <cmath>\n\nnamespace policy {{\n\n"
        "constexpr int feature_count = {}, output_count = {};\n\n",
        model.features(), network.outputs());
    const bool remembers = model.recurrent > 0;
    if (remembers) text += memory_arrays_cpp(model);
    text += with_points(array_text("means", model.normaliser.means));
    text += with_points(array_text("factors", model.normaliser.factors));
    std::size_t widest = static_cast<std::size_t>(network.inputs());
    for (std::size_t l = 0; l < network.layers.size(); ++l) {
        const Layer& layer = network.layers[l];
        text += with_points(
            array_text(fmt::format("weights{}", l), weights_of(layer, model.parameters.data())));
        text += with_points(
            array_text(fmt::format("bias{}", l), bias_of(layer, model.parameters.data())));
        widest = std::max(widest, static_cast<std::size_t>(layer.outputs));
    }
    text += fmt::format(
        "\ninline void layer(const float* weights, const float* bias, int inputs, int outputs, "
        "bool last,\n"
        "                  const float* from, float* to) {{\n"
        "    for (int o = 0; o < outputs; ++o) {{\n"
        "        float sum = bias[o];\n"
        "        for (int i = 0; i < inputs; ++i) sum += weights[o * inputs + i] * from[i];\n"
        "        to[o] = last ? sum : {4};\n    }}\n}}\n\n"
        "{1}inline void act(const float* features, {2}float* outputs) {{\n"
        "    float a[{0}], b[{0}];\n"
        "    for (int f = 0; f < feature_count; ++f) {{\n"
        "        const float x = (features[f] - means[f]) * factors[f];\n"
        "        a[f] = x > 10 ? 10 : x < -10 ? -10 : x;\n    }}\n{3}",
        widest, remembers ? remember_cpp : "", remembers ? "float* memory, " : "",
        remembers ? "    remember(a, memory);\n"
                    "    for (int u = 0; u < memory_count; ++u) a[feature_count + u] = memory[u];\n"
                  : "",
        activation_cpp(network.activation));
    for (std::size_t l = 0; l < network.layers.size(); ++l) {
        const Layer& layer = network.layers[l];
        const bool last = l + 1 == network.layers.size();
        text += fmt::format("    layer(weights{0}, bias{0}, {1}, {2}, {3}, {4}, {5});\n", l,
                            layer.inputs, layer.outputs, last, l % 2 ? "b" : "a",
                            last    ? "outputs"
                            : l % 2 ? "a"
                                    : "b");
    }
    const std::vector<float> squashed = squashed_outputs(model);
    for (std::size_t o = 0; o < squashed.size(); ++o)
        if (squashed[o] > 0)
            text += fmt::format("    outputs[{0}] = std::tanh(outputs[{0}]);\n", o);
    return text + "}\n\n}  // namespace policy\n";
}

std::string ppo_policy_onnx(const PpoModel& model) {
    const Network& network = model.policy;
    const std::vector<float> squashed = squashed_outputs(model);
    const bool squashes = std::ranges::count(squashed, 1.0f) > 0;
    std::string graph;
    const auto add_node = [&](const std::string& bytes) {
        append_bytes(graph, 1, bytes);
    };
    const bool remembers = model.recurrent > 0;
    add_node(node("Sub", {"features", "means"}, {"centred"}));
    add_node(node("Mul", {"centred", "factors"}, {"scaled"}));
    add_node(node("Clip", {"scaled", "least", "most"}, {remembers ? "seen" : "x0"}));
    if (remembers) {
        // A sequence of one step.
        add_node(node("Unsqueeze", {"seen", "first"}, {"sequence"}));
        add_node(node("Unsqueeze", {"memory", "first"}, {"states"}));
        add_node(node(
            "GRU", {"sequence", "memory_input", "memory_state", "memory_bias", "", "states"},
            {"", "next_states"}, {{"hidden_size", model.recurrent}, {"linear_before_reset", 1}}));
        add_node(node("Squeeze", {"next_states", "first"}, {"next_memory"}));
        add_node(node("Concat", {"seen", "next_memory"}, {"x0"}, {{"axis", 1}}));
    }
    for (std::size_t l = 0; l < network.layers.size(); ++l) {
        const bool last = l + 1 == network.layers.size();
        add_node(node(
            "Gemm", {fmt::format("x{}", l), fmt::format("weights{}", l), fmt::format("bias{}", l)},
            {last ? (squashes ? "all" : "outputs") : fmt::format("sum{}", l)}, {{"transB", 1}}));
        if (!last)
            add_node(node(network.activation == Activation::Relu ? "Relu" : "Tanh",
                          {fmt::format("sum{}", l)}, {fmt::format("x{}", l + 1)}));
    }
    if (squashes) {
        // all + squashed * (tanh(all) - all)
        add_node(node("Tanh", {"all"}, {"tanh"}));
        add_node(node("Sub", {"tanh", "all"}, {"change"}));
        add_node(node("Mul", {"change", "squashed"}, {"some"}));
        add_node(node("Add", {"all", "some"}, {"outputs"}));
    }
    append_bytes(graph, 2, "policy");
    const auto add_tensor = [&](const std::string& name, const std::vector<std::int64_t>& shape,
                                const std::vector<float>& values) {
        append_bytes(graph, 5, tensor(name, shape, values));
    };
    add_tensor("means", {model.features()}, model.normaliser.means);
    add_tensor("factors", {model.features()}, model.normaliser.factors);
    if (squashes) add_tensor("squashed", {network.outputs()}, squashed);
    if (remembers) {
        const GruArrays arrays = arrays_of(model, {2, 1, 0});
        const std::int64_t units = model.recurrent;
        add_tensor("memory_input", {1, 3 * units, model.features()}, arrays.input);
        add_tensor("memory_state", {1, 3 * units, units}, arrays.state);
        add_tensor("memory_bias", {1, 6 * units}, arrays.bias);
        append_bytes(graph, 5, axes_tensor("first", 0));
    }
    add_tensor("least", {}, {-10});
    add_tensor("most", {}, {10});
    for (std::size_t l = 0; l < network.layers.size(); ++l) {
        const Layer& layer = network.layers[l];
        add_tensor(fmt::format("weights{}", l), {layer.outputs, layer.inputs},
                   weights_of(layer, model.parameters.data()));
        add_tensor(fmt::format("bias{}", l), {layer.outputs},
                   bias_of(layer, model.parameters.data()));
    }
    append_bytes(graph, 11, value_info("features", model.features()));
    if (remembers) append_bytes(graph, 11, value_info("memory", model.recurrent));
    append_bytes(graph, 12, value_info("outputs", network.outputs()));
    if (remembers) append_bytes(graph, 12, value_info("next_memory", model.recurrent));
    std::string opset, out;
    append_bytes(opset, 1, "");
    append_number(opset, 2, 13);
    append_number(out, 1, 7);  // version of the format
    append_bytes(out, 2, "rddlc");
    append_bytes(out, 7, graph);
    append_bytes(out, 8, opset);
    return out;
}

}  // namespace rddlc::solvers
