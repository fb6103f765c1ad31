// Networks of tanh or relu layers, of any width and depth, on rows of samples.
//
// Parameters of a network are one array of numbers, in the order of the layers: the weights and
// then the bias. The weights are a row of padded_outputs numbers for each input. If the last layer
// has few outputs, most of these would be padding: then they are a row of padded_inputs numbers for
// each output. What pads rows is 0 and stays so.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace rddlc::solvers {

// Rows of results have a multiple of so many numbers.
inline constexpr int padding = 8;
constexpr int padded(int count) {
    return (count + padding - 1) / padding * padding;
}

// A layer's weights: (i, o) is that from input i to output o.
template <class Real>
struct Weights {
    Real* data;
    int inputs, outputs;
    std::ptrdiff_t input_step, output_step;
    Real& operator()(int i, int o) const { return data[i * input_step + o * output_step]; }
};

struct Layer {
    int inputs = 0, outputs = 0;
    int padded_inputs = 0, padded_outputs = 0;
    bool by_outputs = false;            // weights have a row for each output
    std::size_t weights = 0, bias = 0;  // where they begin in the array of parameters
    std::size_t rows = 0;               // where the weights' rows begin in that of rows
    std::size_t values = 0;             // where its results begin in a sample's activations

    // The weights of the layer in the array of the network's parameters.
    template <class Real>
    Weights<Real> weights_in(Real* parameters) const {
        return {parameters + weights, inputs, outputs, by_outputs ? 1 : padded_outputs,
                by_outputs ? padded_inputs : 1};
    }
};

enum class Activation { Tanh, Relu };  // Relu: max(0, x)

inline const char* name_of(Activation activation) {
    return activation == Activation::Relu ? "relu" : "tanh";
}
// Returns nothing if no activation has this name.
inline std::optional<Activation> activation_named(std::string_view name) {
    for (const Activation each : {Activation::Tanh, Activation::Relu})
        if (name == name_of(each)) return each;
    return std::nullopt;
}

// All hidden layers end with the activation, the last one with nothing.
struct Network {
    std::vector<Layer> layers;
    Activation activation = Activation::Tanh;
    int inner = 0;  // of the inputs, the last ones, come from another network; backward() reports
                    // their gradient
    std::size_t parameters = 0;  // numbers
    std::size_t rows = 0;  // numbers: weights as [output][padded input], for backward(); of the
                           // first layer those of the inner inputs
    std::size_t activations = 0;  // numbers of a sample: results of all layers
    int inputs() const { return layers.front().inputs; }
    int outputs() const { return layers.back().outputs; }
    int padded_outputs() const { return layers.back().padded_outputs; }
};

Network make_network(int inputs, const std::vector<int>& hidden, int outputs, int inner = 0,
                     Activation activation = Activation::Tanh);

// Samples that go through all layers together, so that what they need stays in a processor's cache.
inline constexpr int tile = 64;

// The functions of one instruction set. `x` has rows of `x_row` numbers, all other rows are padded;
// `count` is at most a tile. Activations are layer by layer, in each `count` rows.
template <class Real>
struct NetworkFunctions {
    // Results of the last layer stand at layers.back().values * count.
    void (*forward)(const Network&, const Real* parameters, int count, const Real* x, int x_row,
                    Real* activations);
    // Adds the gradient by the parameters to `gradient`, given that by the last layer's results in
    // `d_outputs`, whose padding is 0, and that by the inner inputs to `d_inner` (NULL if the
    // network has no inner inputs), rows of padded(inner) numbers. `rows` is what transpose() has
    // made; `scratch` has as many numbers as the activations.
    void (*backward)(const Network&, const Real* rows, int count, const Real* x, int x_row,
                     const Real* activations, const Real* d_outputs, Real* scratch, Real* gradient,
                     Real* d_inner);
    // The weights as rows.
    void (*transpose)(const Network&, const Real* parameters, Real* rows);
    // The sum of the squares. These sizes are also multiples of the padding.
    double (*squares)(std::size_t count, const Real* numbers);
    // to += from; sizes are multiples of the padding.
    void (*add)(std::size_t count, const Real* from, Real* to);
    // A step of Adam (Kingma and Ba, 2015, algorithm 1), with the bias corrections in `rate` and
    // `root`: p -= rate * m / (sqrt(v) / root + epsilon), after g *= factor.
    void (*adam)(std::size_t count, const Real* gradient, Real factor, Real rate, Real root,
                 Real epsilon, Real* first, Real* second, Real* parameters);
};

// The functions for this processor; RDDL_INSTRUCTION_SET=sse2 in the environment selects those for
// any x86-64.
const NetworkFunctions<float>& network_functions();

}  // namespace rddlc::solvers
