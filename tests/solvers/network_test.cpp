// The networks' functions: in double, where finite differences give derivatives, and in float
// against a plain loop.
#include "solvers/network/network.hpp"

#include "solvers/network/gru.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <random>

namespace rddlc::solvers {

// Includes the variants as network.cpp does, for doubles.
namespace doubles {
#define RDDL_VECTOR_BYTES 16
#define RDDL_WIDE_BYTES 16
#include "solvers/network/variant.hpp"
#undef RDDL_WIDE_BYTES
#undef RDDL_VECTOR_BYTES
}  // namespace doubles

namespace {

template <class Real>
std::vector<Real> numbers(std::size_t count, unsigned seed, double scale = 1) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, scale);
    std::vector<Real> all(count);
    for (Real& number : all) number = static_cast<Real>(normal(random));
    return all;
}

// A derivative by finite differences, from a small change to both sides.
double derivative(double& number, const auto& loss) {
    const double before = number, step = 1e-6;
    number = before + step;
    const double more = loss();
    number = before - step;
    const double less = loss();
    number = before;
    return (more - less) / (2 * step);
}

// The places of the weights and the bias in the array of parameters.
std::vector<std::size_t> places_of(const Network& network, const Layer& layer) {
    std::vector<std::size_t> all(network.parameters), places;
    std::iota(all.begin(), all.end(), std::size_t{0});
    for (int o = 0; o < layer.outputs; ++o) {
        for (int i = 0; i < layer.inputs; ++i) places.push_back(layer.weights_in(all.data())(i, o));
        places.push_back(layer.bias + static_cast<std::size_t>(o));
    }
    return places;
}

// Parameters whose padding is 0.
template <class Real>
std::vector<Real> parameters_of(const Network& network, unsigned seed) {
    const std::vector<Real> random = numbers<Real>(network.parameters, seed, 0.5);
    std::vector<Real> all(network.parameters);
    for (const Layer& layer : network.layers)
        for (const std::size_t p : places_of(network, layer)) all[p] = random[p];
    return all;
}

std::vector<double> plain_outputs(const Network& network, const std::vector<double>& parameters,
                                  std::vector<double> x) {
    for (const Layer& layer : network.layers) {
        std::vector<double> next(static_cast<std::size_t>(layer.outputs));
        for (int o = 0; o < layer.outputs; ++o) {
            double sum = parameters[layer.bias + static_cast<std::size_t>(o)];
            for (int i = 0; i < layer.inputs; ++i)
                sum += layer.weights_in(parameters.data())(i, o) * x[static_cast<std::size_t>(i)];
            const bool last = &layer == &network.layers.back();
            const bool relu = network.activation == Activation::Relu;
            next[static_cast<std::size_t>(o)] = last   ? sum
                                                : relu ? std::max(sum, 0.0)
                                                       : std::tanh(sum);
        }
        x = next;
    }
    return x;
}

// Networks of these shapes with each activation.
std::vector<Network> networks_of(int inputs, const std::vector<std::vector<int>>& shapes,
                                 int outputs, int inner = 0) {
    std::vector<Network> all;
    for (const std::vector<int>& hidden : shapes)
        for (const Activation activation : {Activation::Tanh, Activation::Relu})
            all.push_back(make_network(inputs, hidden, outputs, inner, activation));
    return all;
}

TEST(Network, ComputesWhatAPlainLoopDoes) {
    std::vector<Network> networks = networks_of(3, {{}, {5}, {64, 64}, {13, 7, 9}}, 5);
    std::ranges::copy(networks_of(3, {{}, {64, 64}, {13, 70}}, 2), std::back_inserter(networks));
    for (const Network& network : networks) {
        const auto parameters = parameters_of<double>(network, 1);
        const std::vector<float> floats(parameters.begin(), parameters.end());
        for (const int count : {1, 2, 5, 6, 7, 64}) {
            const auto x = numbers<double>(static_cast<std::size_t>(count * 3), 2);
            const std::vector<float> float_x(x.begin(), x.end());
            std::vector<float> activations(network.activations * static_cast<std::size_t>(count));
            network_functions().forward(network, floats.data(), count, float_x.data(), 3,
                                        activations.data());
            for (int s = 0; s < count; ++s) {
                const auto expected =
                    plain_outputs(network, parameters, {x.begin() + 3 * s, x.begin() + 3 * s + 3});
                const float* const found =
                    activations.data() +
                    network.layers.back().values * static_cast<std::size_t>(count) +
                    s * network.padded_outputs();
                for (std::size_t o = 0; o < expected.size(); ++o)
                    EXPECT_NEAR(found[o], expected[o], 2e-5) << count << " " << s;
            }
        }
    }
}

// Whatever else is computed with it.
TEST(Network, GivesASampleTheSameBitsInEveryBatch) {
    for (const Network& network : {make_network(4, {64, 32}, 3), make_network(4, {96, 70}, 5)}) {
        const auto parameters = parameters_of<float>(network, 3);
        const auto x = numbers<float>(64 * 4, 4);
        const int row = network.padded_outputs();
        const auto outputs = [&](int first, int count) {
            std::vector<float> activations(network.activations * static_cast<std::size_t>(count));
            network_functions().forward(network, parameters.data(), count, x.data() + first * 4, 4,
                                        activations.data());
            const auto begin = activations.begin() +
                               static_cast<std::ptrdiff_t>(network.layers.back().values) * count;
            return std::vector<float>(begin, begin + count * row);
        };
        const auto all = outputs(0, 64);
        for (const auto& [first, count] : {std::pair{0, 1}, {7, 1}, {7, 2}, {40, 24}}) {
            const auto some = outputs(first, count);
            for (std::size_t i = 0; i < some.size(); ++i)
                EXPECT_EQ(some[i], all[i + static_cast<std::size_t>(first * row)]);
        }
    }
}

TEST(Network, TanhIsPreciseEverywhere) {
    const Network network = make_network(1, {8}, 1);
    std::vector<float> parameters(network.parameters);
    parameters[0] = 1;  // the first unit is tanh(x)
    for (double x = -12; x <= 12; x += 0.00137) {
        const auto number = static_cast<float>(x);
        std::vector<float> activations(network.activations);
        network_functions().forward(network, parameters.data(), 1, &number, 1, activations.data());
        const double expected = std::tanh(static_cast<double>(number));
        EXPECT_NEAR(activations[0], expected, 4e-7 * std::abs(expected)) << x;
    }
}

// Descent detects nan, so networks must not hide it.
TEST(Network, HidesNoNumberThatIsNone) {
    for (const Network& network : networks_of(1, {{9}}, 1)) {
        const auto parameters = parameters_of<float>(network, 10);
        const float number = std::nanf("");
        std::vector<float> activations(network.activations);
        network_functions().forward(network, parameters.data(), 1, &number, 1, activations.data());
        EXPECT_TRUE(std::isnan(activations[network.layers.back().values]))
            << name_of(network.activation);
    }
}

TEST(Network, GradientAgreesWithFiniteDifferences) {
    for (const Network& network : networks_of(3, {{}, {6}, {9, 5}, {4, 3, 7}}, 2)) {
        auto parameters = parameters_of<double>(network, 5);
        constexpr int count = 7;
        const auto x = numbers<double>(count * 3, 6);
        auto weights =
            numbers<double>(static_cast<std::size_t>(count * network.padded_outputs()), 7);
        for (int s = 0; s < count; ++s)
            for (int o = 2; o < network.padded_outputs(); ++o)
                weights[static_cast<std::size_t>(s * network.padded_outputs() + o)] = 0;
        const auto& functions = doubles::functions<double>;
        std::vector<double> activations(network.activations * count), scratch(activations.size());
        const auto loss = [&] {
            functions.forward(network, parameters.data(), count, x.data(), 3, activations.data());
            const double* const outputs = activations.data() + network.layers.back().values * count;
            double sum = 0;
            for (std::size_t i = 0; i < weights.size(); ++i) sum += outputs[i] * weights[i];
            return sum;
        };
        loss();
        std::vector<double> rows(network.rows), gradient(network.parameters);
        functions.transpose(network, parameters.data(), rows.data());
        functions.backward(network, rows.data(), count, x.data(), 3, activations.data(),
                           weights.data(), scratch.data(), gradient.data(), nullptr);
        for (const Layer& layer : network.layers)
            for (const std::size_t p : places_of(network, layer))
                EXPECT_NEAR(gradient[p], derivative(parameters[p], loss), 1e-6);
    }
}

// The gradient by the last inputs, which another network has made.
TEST(Network, TellsTheGradientByItsInnerInputs) {
    constexpr int count = 5, inputs = 7, inner = 3;
    for (const Network& network : networks_of(inputs, {{}, {9}, {4, 6}}, 2, inner)) {
        const auto parameters = parameters_of<double>(network, 8);
        auto x = numbers<double>(count * inputs, 9);
        std::vector<double> weights(static_cast<std::size_t>(count * network.padded_outputs()));
        for (int s = 0; s < count; ++s)
            weights[static_cast<std::size_t>(s * network.padded_outputs() + 1)] = 1 + s;
        const auto& functions = doubles::functions<double>;
        std::vector<double> activations(network.activations * count), scratch(activations.size());
        const auto loss = [&] {
            functions.forward(network, parameters.data(), count, x.data(), inputs,
                              activations.data());
            const double* const outputs = activations.data() + network.layers.back().values * count;
            return std::inner_product(weights.begin(), weights.end(), outputs, 0.0);
        };
        loss();
        std::vector<double> rows(network.rows), gradient(network.parameters);
        std::vector<double> d_inner(count * padded(inner), 1.0);  // it is added to
        functions.transpose(network, parameters.data(), rows.data());
        functions.backward(network, rows.data(), count, x.data(), inputs, activations.data(),
                           weights.data(), scratch.data(), gradient.data(), d_inner.data());
        for (std::size_t s = 0; s < count; ++s)
            for (std::size_t i = 0; i < inner; ++i)
                EXPECT_NEAR(d_inner[s * padded(inner) + i] - 1,
                            derivative(x[s * inputs + inputs - inner + i], loss), 1e-6);
    }
}

// ------------------------------------------------------------------------------- what remembers

// Parameters whose padding is 0.
std::vector<double> gru_parameters(const Gru& gru, unsigned seed) {
    std::vector<double> all = numbers<double>(gru.parameters, seed, 0.7);
    for (std::size_t p = 0; p < all.size(); ++p)
        if (static_cast<int>(p) % gru.padded_units >= gru.units) all[p] = 0;
    return all;
}

// The state after a step, by the equations in gru.hpp.
std::vector<double> plain_step(const Gru& gru, const std::vector<double>& parameters,
                               const double* x, const std::vector<double>& h) {
    const auto sum = [&](std::size_t begin, int part, const double* from, int count, int unit) {
        double all = 0;
        for (int i = 0; i < count; ++i)
            all += from[i] * parameters[begin + static_cast<std::size_t>(
                                                    (3 * i + part) * gru.padded_units + unit)];
        return all;
    };
    const auto of_input = [&](int part, int unit) {  // n, r, z
        return sum(gru.input_weights, part, x, gru.inputs, unit);
    };
    const auto of_state = [&](int part, int unit) {  // r, z, n
        return sum(gru.state_weights, part, h.data(), gru.units, unit);
    };
    const auto bias = [&](int part, int unit) {  // n, r, z, and of the state's n
        return parameters[gru.bias + static_cast<std::size_t>(part * gru.padded_units + unit)];
    };
    const auto sigmoid = [](double number) {
        return 1 / (1 + std::exp(-number));
    };
    std::vector<double> next(h.size());
    for (int u = 0; u < gru.units; ++u) {
        const double r = sigmoid(of_input(1, u) + of_state(0, u) + bias(1, u));
        const double z = sigmoid(of_input(2, u) + of_state(1, u) + bias(2, u));
        const double n = std::tanh(of_input(0, u) + bias(0, u) + r * (of_state(2, u) + bias(3, u)));
        next[static_cast<std::size_t>(u)] = (1 - z) * n + z * h[static_cast<std::size_t>(u)];
    }
    return next;
}

// Rows of steps that become fewer, as segments of unequal length have them; episodes begin in them.
struct RowsOfSteps {
    std::vector<int> counts = {5, 5, 5, 5, 2, 1};
    std::vector<std::uint8_t> begins = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0,
                                        0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0};
    int all() const { return std::accumulate(counts.begin(), counts.end(), 0); }
    Sequence sequence() const { return {counts, begins.data()}; }
};

TEST(Gru, ComputesWhatThePlainEquationsDo) {
    for (const auto& [inputs, units] : {std::pair{1, 1}, {3, 5}, {4, 8}, {2, 19}}) {
        const Gru gru = make_gru(inputs, units);
        const auto parameters = gru_parameters(gru, 1);
        const std::vector<float> floats(parameters.begin(), parameters.end());
        const RowsOfSteps steps;
        const auto rows = static_cast<std::size_t>(steps.all());
        const auto row = static_cast<std::size_t>(gru.padded_units);
        // States come behind the inputs of the same row, as networks see them.
        const std::size_t x_row = static_cast<std::size_t>(inputs) + row;
        const auto x = numbers<double>(rows * x_row, 2);
        auto initial = numbers<double>(static_cast<std::size_t>(steps.counts[0]) * row, 3, 0.5);
        for (std::size_t i = 0; i < initial.size(); ++i)
            if (i % row >= static_cast<std::size_t>(units)) initial[i] = 0;
        std::vector<float> float_x(x.begin(), x.end());
        const std::vector<float> float_initial(initial.begin(), initial.end());
        std::vector<float> before(rows * row),
            values(rows * static_cast<std::size_t>(gru.values()));
        gru_functions().forward(gru, floats.data(), steps.sequence(), float_x.data(),
                                static_cast<int>(x_row), float_initial.data(), before.data(),
                                values.data(), float_x.data() + inputs, static_cast<int>(x_row));
        std::vector<std::vector<double>> states;
        std::size_t at = 0;
        for (std::size_t t = 0; t < steps.counts.size(); ++t)
            for (std::size_t s = 0; s < static_cast<std::size_t>(steps.counts[t]); ++s, ++at) {
                if (t == 0) {
                    const auto begin = initial.begin() + static_cast<std::ptrdiff_t>(s * row);
                    states.emplace_back(begin, begin + units);
                }
                if (steps.begins[at]) states[s].assign(states[s].size(), 0.0);
                states[s] = plain_step(gru, parameters, x.data() + at * x_row, states[s]);
                for (std::size_t u = 0; u < row; ++u)
                    EXPECT_NEAR(float_x[at * x_row + static_cast<std::size_t>(inputs) + u],
                                u < states[s].size() ? states[s][u] : 0, 2e-6)
                        << t << " " << s << " " << u;
            }
    }
}

TEST(Gru, GradientAgreesWithFiniteDifferencesThroughTime) {
    // clang++ 14 captures no structured bindings.
    for (const std::pair<int, int>& size : {std::pair{2, 3}, {3, 9}}) {
        const int inputs = size.first, units = size.second;
        const Gru gru = make_gru(inputs, units);
        auto parameters = gru_parameters(gru, 4);
        const RowsOfSteps steps;
        const auto rows = static_cast<std::size_t>(steps.all());
        const auto row = static_cast<std::size_t>(gru.padded_units);
        const auto x = numbers<double>(rows * static_cast<std::size_t>(inputs), 5);
        std::vector<double> initial(static_cast<std::size_t>(steps.counts[0]) * row);
        auto weights = numbers<double>(rows * row, 6);
        for (std::size_t i = 0; i < weights.size(); ++i) {
            const bool pads = i % row >= static_cast<std::size_t>(units);
            if (pads) weights[i] = 0;
            if (!pads && i < initial.size()) initial[i] = 0.3;
        }
        const auto& functions = doubles::gru_functions_of<double>;
        std::vector<double> before(rows * row), after(rows * row);
        std::vector<double> values(rows * static_cast<std::size_t>(gru.values()));
        const auto loss = [&] {
            functions.forward(gru, parameters.data(), steps.sequence(), x.data(), inputs,
                              initial.data(), before.data(), values.data(), after.data(),
                              gru.padded_units);
            return std::inner_product(weights.begin(), weights.end(), after.begin(), 0.0);
        };
        loss();
        std::vector<double> gradient(gru.parameters), u_rows(gru.rows), scratch(initial.size());
        std::vector<double> d_after = weights;
        functions.transpose(gru, parameters.data(), u_rows.data());
        functions.backward(gru, u_rows.data(), steps.sequence(), x.data(), inputs, before.data(),
                           values.data(), d_after.data(), scratch.data(), gradient.data());
        double greatest = 0;
        for (std::size_t p = 0; p < parameters.size(); ++p) {
            if (static_cast<int>(p) % gru.padded_units >= units) {
                EXPECT_EQ(gradient[p], 0) << p;
                continue;
            }
            EXPECT_NEAR(gradient[p], derivative(parameters[p], loss), 1e-7) << p;
            greatest = std::max(greatest, std::abs(gradient[p]));
        }
        EXPECT_GT(greatest, 1);
    }
}

}  // namespace
}  // namespace rddlc::solvers
