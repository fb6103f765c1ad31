// NetworkFunctions and GruFunctions for one instruction set. Included once for each, within a
// namespace of its own; includes nothing that would be compiled for it.

#include "solvers/network/kernels.hpp"

// Of hidden layers.
template <class Real>
inline void end_layer(Activation activation, int rows, int columns, const Real* bias, Real* x) {
    if (activation == Activation::Relu)
        add_bias<Relu>(rows, columns, bias, x);
    else
        add_bias<Tanh>(rows, columns, bias, x);
}
template <class Real>
inline void end_layer_back(Activation activation, int count, const Real* h, Real* d) {
    if (activation == Activation::Relu)
        times_derivative<Relu>(count, h, d);
    else
        times_derivative<Tanh>(count, h, d);
}

template <class Real>
void forward(const Network& network, const Real* parameters, int count, const Real* x, int x_row,
             Real* activations) {
    const std::size_t layers = network.layers.size();
    for (std::size_t l = 0; l < layers; ++l) {
        const Layer& layer = network.layers[l];
        Real* const values = activations + layer.values * static_cast<std::size_t>(count);
        product<false>(count, layer.padded_outputs, layer.inputs, Strided<Real>{x, x_row, 1},
                       parameters + layer.weights, layer.padded_outputs, values,
                       layer.padded_outputs);
        const Real* const bias = parameters + layer.bias;
        if (l + 1 < layers)
            end_layer(network.activation, count, layer.padded_outputs, bias, values);
        else
            add_bias<Linear>(count, layer.padded_outputs, bias, values);
        x = values;
        x_row = layer.padded_outputs;
    }
}

template <class Real>
void backward(const Network& network, const Real* rows, int count, const Real* x, int x_row,
              const Real* activations, const Real* d_outputs, Real* scratch, Real* gradient,
              Real* d_inner) {
    const auto values_of = [&](std::size_t l) {
        return activations + network.layers[l].values * static_cast<std::size_t>(count);
    };
    const Real* d = d_outputs;
    for (std::size_t l = network.layers.size(); l-- > 0;) {
        const Layer& layer = network.layers[l];
        const Real* const input = l > 0 ? values_of(l - 1) : x;
        const int input_row = l > 0 ? layer.padded_inputs : x_row;
        product<true>(layer.inputs, layer.padded_outputs, count, Strided<Real>{input, 1, input_row},
                      d, layer.padded_outputs, gradient + layer.weights, layer.padded_outputs);
        add_rows(count, layer.padded_outputs, d, gradient + layer.bias);
        if (l == 0) {
            const int inner = padded(network.inner);
            product<true>(count, inner, layer.outputs, Strided<Real>{d, layer.padded_outputs, 1},
                          rows + layer.rows, inner, d_inner, inner);
            return;
        }
        Real* const d_input =
            scratch + network.layers[l - 1].values * static_cast<std::size_t>(count);
        product<false>(count, layer.padded_inputs, layer.outputs,
                       Strided<Real>{d, layer.padded_outputs, 1}, rows + layer.rows,
                       layer.padded_inputs, d_input, layer.padded_inputs);
        end_layer_back(network.activation, count * layer.padded_inputs, input, d_input);
        d = d_input;
    }
}

template <class Real>
void transpose(const Network& network, const Real* parameters, Real* rows) {
    for (std::size_t l = 0; l < network.layers.size(); ++l) {
        const Layer& layer = network.layers[l];
        const int first = l == 0 ? layer.inputs - network.inner : 0;
        const int row = padded(layer.inputs - first);
        const Real* const from = parameters + layer.weights;
        Real* const to = rows + layer.rows;
        for (int o = 0; o < layer.outputs; ++o)
            for (int i = first; i < layer.inputs; ++i)
                to[o * row + i - first] = from[i * layer.padded_outputs + o];
    }
}

// In as many sums as the padding, so that instruction sets do not differ.
template <class Real>
double squares(std::size_t count, const Real* numbers) {
    double sums[padding] = {};
    for (std::size_t i = 0; i < count; i += padding)
        for (int k = 0; k < padding; ++k) {
            const auto number = static_cast<double>(numbers[i + static_cast<std::size_t>(k)]);
            sums[k] += number * number;
        }
    double all = 0;
    for (const double sum : sums) all += sum;
    return all;
}

template <class Real>
void add(std::size_t count, const Real* from, Real* to) {
    for (std::size_t i = 0; i < count; i += VectorOf<Real>::width)
        store(to + i, load(to + i) + load(from + i));
}

inline Vector<float> root_of(Vector<float> x) {
    for (int i = 0; i < VectorOf<float>::width; ++i) x[i] = __builtin_sqrtf(x[i]);
    return x;
}
inline Vector<double> root_of(Vector<double> x) {
    for (int i = 0; i < VectorOf<double>::width; ++i) x[i] = __builtin_sqrt(x[i]);
    return x;
}

template <class Real>
void adam(std::size_t count, const Real* gradient, Real factor, Real rate, Real root, Real epsilon,
          Real* first, Real* second, Real* parameters) {
    constexpr Real beta1 = Real(0.9), beta2 = Real(0.999);
    for (std::size_t i = 0; i < count; i += VectorOf<Real>::width) {
        const Vector<Real> g = load(gradient + i) * factor;
        const Vector<Real> m = load(first + i) * beta1 + g * (1 - beta1);
        const Vector<Real> v = load(second + i) * beta2 + g * g * (1 - beta2);
        store(first + i, m);
        store(second + i, v);
        store(parameters + i, load(parameters + i) - rate * m / (root_of(v) / root + epsilon));
    }
}

template <class Real>
constexpr NetworkFunctions<Real> functions{forward<Real>, backward<Real>, transpose<Real>,
                                           squares<Real>, add<Real>,      adam<Real>};

#include "solvers/network/gru_variant.hpp"
