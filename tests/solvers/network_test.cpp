// The networks' functions: in double, where derivatives can be told by finite differences, and in
// float against a plain loop.
#include "solvers/network/network.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>

namespace rddlc::solvers {

// As network.cpp does it, for doubles.
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

// Parameters whose padding is 0.
template <class Real>
std::vector<Real> parameters_of(const Network& network, unsigned seed) {
    std::vector<Real> all = numbers<Real>(network.parameters, seed, 0.5);
    for (const Layer& layer : network.layers)
        for (int r = 0; r <= layer.inputs; ++r)  // the last row is the bias
            for (int o = layer.outputs; o < layer.padded_outputs; ++o)
                all[layer.weights + static_cast<std::size_t>(r * layer.padded_outputs + o)] = 0;
    return all;
}

std::vector<double> plain_outputs(const Network& network, const std::vector<double>& parameters,
                                  std::vector<double> x) {
    for (const Layer& layer : network.layers) {
        std::vector<double> next(static_cast<std::size_t>(layer.outputs));
        for (int o = 0; o < layer.outputs; ++o) {
            double sum = parameters[layer.bias + static_cast<std::size_t>(o)];
            for (int i = 0; i < layer.inputs; ++i)
                sum += parameters[layer.weights +
                                  static_cast<std::size_t>(i * layer.padded_outputs + o)] *
                       x[static_cast<std::size_t>(i)];
            const bool last = &layer == &network.layers.back();
            next[static_cast<std::size_t>(o)] = last ? sum : std::tanh(sum);
        }
        x = next;
    }
    return x;
}

TEST(Network, ComputesWhatAPlainLoopDoes) {
    for (const std::vector<int>& hidden : {std::vector<int>{}, {5}, {64, 64}, {13, 7, 9}}) {
        const Network network = make_network(3, hidden, 5);
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
    const Network network = make_network(4, {64, 32}, 3);
    const auto parameters = parameters_of<float>(network, 3);
    const auto x = numbers<float>(64 * 4, 4);
    const auto outputs = [&](int first, int count) {
        std::vector<float> activations(network.activations * static_cast<std::size_t>(count));
        network_functions().forward(network, parameters.data(), count, x.data() + first * 4, 4,
                                    activations.data());
        const auto begin =
            activations.begin() + static_cast<std::ptrdiff_t>(network.layers.back().values) * count;
        return std::vector<float>(begin, begin + count * network.padded_outputs());
    };
    const auto all = outputs(0, 64);
    for (const auto& [first, count] : {std::pair{0, 1}, {7, 1}, {7, 2}, {40, 24}}) {
        const auto some = outputs(first, count);
        for (std::size_t i = 0; i < some.size(); ++i)
            EXPECT_EQ(some[i], all[i + static_cast<std::size_t>(first * network.padded_outputs())]);
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

TEST(Network, GradientAgreesWithFiniteDifferences) {
    for (const std::vector<int>& hidden : {std::vector<int>{}, {6}, {9, 5}, {4, 3, 7}}) {
        const Network network = make_network(3, hidden, 2);
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
                           weights.data(), scratch.data(), gradient.data());
        for (const Layer& layer : network.layers)
            for (int r = 0; r <= layer.inputs; ++r)
                for (int o = 0; o < layer.outputs; ++o) {
                    const auto p =
                        layer.weights + static_cast<std::size_t>(r * layer.padded_outputs + o);
                    const double before = parameters[p], step = 1e-6;
                    parameters[p] = before + step;
                    const double more = loss();
                    parameters[p] = before - step;
                    const double less = loss();
                    parameters[p] = before;
                    EXPECT_NEAR(gradient[p], (more - less) / (2 * step), 1e-6);
                }
    }
}

}  // namespace
}  // namespace rddlc::solvers
