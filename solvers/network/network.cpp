#include "solvers/network/network.hpp"

#include "solvers/network/gru.hpp"

#include <rddl/lanes/processor.hpp>

#include <cstddef>
#include <cstdint>

namespace rddlc::solvers {

// The same text for each instruction set. The headers above are compiled for any processor.
namespace portable {
#define RDDL_VECTOR_BYTES 16
#define RDDL_WIDE_BYTES 16
#include "solvers/network/variant.hpp"
#undef RDDL_WIDE_BYTES
#undef RDDL_VECTOR_BYTES
}  // namespace portable

#ifdef __x86_64__
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2,fma"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,fma")
#endif
namespace avx2 {
#define RDDL_VECTOR_BYTES 32
#define RDDL_WIDE_BYTES 32
#include "solvers/network/variant.hpp"
#undef RDDL_WIDE_BYTES
#undef RDDL_VECTOR_BYTES
}  // namespace avx2
#ifdef __clang__
#pragma clang attribute pop
#pragma clang attribute push(                                                        \
    __attribute__((target("avx512f,avx512bw,avx512cd,avx512dq,avx512vl,avx2,fma"))), \
    apply_to = function)
#else
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f,avx512bw,avx512cd,avx512dq,avx512vl,avx2,fma")
#endif
namespace avx512 {
#define RDDL_VECTOR_BYTES 32
#define RDDL_WIDE_BYTES 64
#include "solvers/network/variant.hpp"
#undef RDDL_WIDE_BYTES
#undef RDDL_VECTOR_BYTES
}  // namespace avx512
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif

#ifdef __x86_64__
namespace {
rddl::InstructionSet instruction_set() {
    static const rddl::InstructionSet allowed = rddl::allowed_instruction_set();
    return allowed;
}
}  // namespace
#endif

const NetworkFunctions<float>& network_functions() {
#ifdef __x86_64__
    if (instruction_set() == rddl::InstructionSet::Avx512) return avx512::functions<float>;
    if (instruction_set() == rddl::InstructionSet::Avx2) return avx2::functions<float>;
#endif
    return portable::functions<float>;
}

const GruFunctions<float>& gru_functions() {
#ifdef __x86_64__
    if (instruction_set() == rddl::InstructionSet::Avx512) return avx512::gru_functions_of<float>;
    if (instruction_set() == rddl::InstructionSet::Avx2) return avx2::gru_functions_of<float>;
#endif
    return portable::gru_functions_of<float>;
}

Network make_network(int inputs, const std::vector<int>& hidden, int outputs, int inner,
                     Activation activation) {
    Network network;
    network.activation = activation;
    network.inner = inner;
    std::vector<int> widths = hidden;
    widths.push_back(outputs);
    for (const int width : widths) {
        Layer layer;
        layer.inputs = inputs;
        layer.outputs = width;
        layer.padded_inputs = padded(inputs);
        layer.padded_outputs = padded(width);
        const bool is_first = network.layers.empty();
        const bool is_last = network.layers.size() == hidden.size();
        layer.by_outputs = is_last && !is_first && width <= padding / 2;
        layer.weights = network.parameters;
        const int weight_rows = layer.by_outputs ? width : inputs;
        const int weight_row = layer.by_outputs ? layer.padded_inputs : layer.padded_outputs;
        layer.bias = layer.weights +
                     static_cast<std::size_t>(weight_rows) * static_cast<std::size_t>(weight_row);
        network.parameters = layer.bias + static_cast<std::size_t>(layer.padded_outputs);
        layer.rows = network.rows;
        const int row = is_first ? padded(inner) : layer.padded_inputs;
        network.rows += static_cast<std::size_t>(width) * static_cast<std::size_t>(row);
        layer.values = network.activations;
        network.activations += static_cast<std::size_t>(layer.padded_outputs);
        network.layers.push_back(layer);
        inputs = width;
    }
    return network;
}

Gru make_gru(int inputs, int units) {
    Gru gru;
    gru.inputs = inputs;
    gru.units = units;
    gru.padded_units = padded(units);
    const auto columns = static_cast<std::size_t>(3 * gru.padded_units);
    gru.state_weights = static_cast<std::size_t>(inputs) * columns;
    gru.bias = gru.state_weights + static_cast<std::size_t>(units) * columns;
    gru.parameters = gru.bias + static_cast<std::size_t>(gru.values());
    gru.rows = columns * static_cast<std::size_t>(gru.padded_units);
    return gru;
}

}  // namespace rddlc::solvers
