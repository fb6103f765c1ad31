// NetworkFunctions and GruFunctions for one instruction set. Included once for each, within a
// namespace of its own; includes nothing that would be compiled for it.

#include "solvers/network/kernels.hpp"

// visit() the end of hidden layers.
template <class Visit>
inline void with_end(Activation activation, Visit&& visit) {
    if (activation == Activation::Relu)
        visit(Relu{});
    else
        visit(Tanh{});
}

template <class Real>
void forward(const Network& network, const Real* parameters, int count, const Real* x, int x_row,
             Real* activations) {
    for (const Layer& layer : network.layers) {
        const int row = layer.padded_outputs;
        const Real* const weights = parameters + layer.weights;
        const Real* const bias = parameters + layer.bias;
        Real* const values = activations + layer.values * static_cast<std::size_t>(count);
        const auto end_with = [&]<class End>(End) {
            product(count, row, layer.inputs, Strided<Real>{x, x_row, 1}, weights, row,
                    Results<End, Real>{bias, values, row});
        };
        if (layer.by_outputs)
            few_results(count, x_row, layer.outputs, x, weights, bias, values, row);
        else if (&layer == &network.layers.back())
            end_with(Linear{});
        else
            with_end(network.activation, end_with);
        x = values;
        x_row = row;
    }
}

template <class Real>
void backward(const Network& network, const Real* rows, int count, const Real* x, int x_row,
              const Real* activations, const Real* d_outputs, Real* scratch, Real* gradient,
              Real* d_inner) {
    const auto values_of = [&](auto* all, std::size_t l) {
        return all + network.layers[l].values * static_cast<std::size_t>(count);
    };
    const Real* d = d_outputs;
    for (std::size_t l = network.layers.size(); l-- > 0;) {
        const Layer& layer = network.layers[l];
        const Real* const input = l > 0 ? values_of(activations, l - 1) : x;
        const int input_row = l > 0 ? layer.padded_inputs : x_row, d_row = layer.padded_outputs;
        if (layer.by_outputs)
            product(layer.outputs, input_row, count, Strided<Real>{d, 1, d_row}, input, input_row,
                    Added<Real>{gradient + layer.weights, input_row});
        else
            product(layer.inputs, d_row, count, Strided<Real>{input, 1, input_row}, d, d_row,
                    Added<Real>{gradient + layer.weights, d_row});
        add_rows(count, d_row, d, gradient + layer.bias);
        const Strided<Real> d_rows{d, d_row, 1};
        if (l == 0) {
            const int inner = padded(network.inner);
            product(count, inner, layer.outputs, d_rows, rows + layer.rows, inner,
                    Added<Real>{d_inner, inner});
            return;
        }
        Real* const d_input = values_of(scratch, l - 1);
        with_end(network.activation, [&]<class End>(End) {
            product(count, input_row, layer.outputs, d_rows, rows + layer.rows, input_row,
                    Derivatives<End, Real>{input, d_input, input_row});
        });
        d = d_input;
    }
}

template <class Real>
void transpose(const Network& network, const Real* parameters, Real* rows) {
    for (std::size_t l = 0; l < network.layers.size(); ++l) {
        const Layer& layer = network.layers[l];
        const int first = l == 0 ? layer.inputs - network.inner : 0;
        const int row = padded(layer.inputs - first);
        const Weights<const Real> weights = layer.weights_in(parameters);
        Real* const to = rows + layer.rows;
        for (int o = 0; o < layer.outputs; ++o)
            for (int i = first; i < layer.inputs; ++i) to[o * row + i - first] = weights(i, o);
    }
}

// Adds in as many sums as the padding, so that instruction sets do not differ.
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
    const Real by_root = 1 / root;
    for (std::size_t i = 0; i < count; i += VectorOf<Real>::width) {
        const Vector<Real> g = load(gradient + i) * factor;
        const Vector<Real> m = load(first + i) * beta1 + g * (1 - beta1);
        const Vector<Real> v = load(second + i) * beta2 + g * g * (1 - beta2);
        store(first + i, m);
        store(second + i, v);
        store(parameters + i, load(parameters + i) - rate * m / (root_of(v) * by_root + epsilon));
    }
}

template <class Real>
constexpr NetworkFunctions<Real> functions{forward<Real>, backward<Real>, transpose<Real>,
                                           squares<Real>, add<Real>,      adam<Real>};

#include "solvers/network/gru_variant.hpp"
