// The network of solvers/network beside the same computation with Eigen, in one run: rows of 64
// samples go forward and backward through a tanh network of 64-64 units.
//
//   c++ -std=c++20 -O3 -mavx2 -mfma -fno-math-errno -ffp-contract=fast -I. -Iruntime
//       -I/usr/include/eigen3 benchmarks/solvers/eigen.cpp solvers/network/network.cpp
//       -o /tmp/eigen && /tmp/eigen
//
// With -DDYNAMIC Eigen does not know the sizes of layers when it is compiled, as --hidden requires.
// Rates are of processor time, the best of many repetitions in turn, so they hardly change on a
// busy machine.
#include "solvers/network/network.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <random>
#include <vector>

using namespace rddlc::solvers;

namespace {

constexpr int inputs = 8, units = 64, outputs = 8;  // as they are padded

#ifdef DYNAMIC
constexpr int size(int) {
    return Eigen::Dynamic;
}
#else
constexpr int size(int known) {
    return known;
}
#endif

template <int columns>
using Rows = Eigen::Matrix<float, Eigen::Dynamic, size(columns), Eigen::RowMajor>;
template <int rows, int columns>
using Weights = Eigen::Map<const Eigen::Matrix<float, size(rows), size(columns), Eigen::RowMajor>>;
template <int columns>
using Row = Eigen::Map<const Eigen::Matrix<float, 1, size(columns)>>;

// Statements as Eigen vectorises them: a sum and a tanh in one expression are three times as slow.
template <int from, int to, bool squashes>
void layer_forward(const float* parameters, const Rows<from>& x, Rows<to>& h) {
    h.noalias() = x * Weights<from, to>(parameters, from, to);
    h.rowwise() += Row<to>(parameters + from * to, to);
    if constexpr (squashes) h = h.array().tanh();
}

template <int from, int to, bool goes_on>
void layer_backward(const float* parameters, const Rows<from>& x, const Rows<to>& d,
                    float* gradient, Rows<from>& d_x) {
    Eigen::Map<Eigen::Matrix<float, size(from), size(to), Eigen::RowMajor>>(gradient, from, to)
        .noalias() += x.transpose() * d;
    Eigen::Map<Eigen::Matrix<float, 1, size(to)>>(gradient + from * to, to) += d.colwise().sum();
    if constexpr (goes_on) {
        d_x.noalias() = d * Weights<from, to>(parameters, from, to).transpose();
        d_x.array() *= 1 - x.array().square();
    }
}

struct WithEigen {
    Rows<inputs> x{tile, inputs}, d_x{tile, inputs};
    Rows<units> h1{tile, units}, h2{tile, units}, d1{tile, units}, d2{tile, units};
    Rows<outputs> y{tile, outputs}, d_y{tile, outputs};

    void forward(const Network& network, const float* p) {
        layer_forward<inputs, units, true>(p + network.layers[0].weights, x, h1);
        layer_forward<units, units, true>(p + network.layers[1].weights, h1, h2);
        layer_forward<units, outputs, false>(p + network.layers[2].weights, h2, y);
    }
    void backward(const Network& network, const float* p, float* g) {
        const auto at = [&](std::size_t l) {
            return network.layers[l].weights;
        };
        layer_backward<units, outputs, true>(p + at(2), h2, d_y, g + at(2), d2);
        layer_backward<units, units, true>(p + at(1), h1, d2, g + at(1), d1);
        layer_backward<inputs, units, false>(p + at(0), x, d1, g + at(0), d_x);
    }
};

double seconds_of(const auto& work, int times) {
    const std::clock_t begin = std::clock();
    for (int i = 0; i < times; ++i) work();
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / times;
}

}  // namespace

int main() {
    const Network network = make_network(inputs, {units, units}, outputs);
    const NetworkFunctions<float>& own = network_functions();
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    std::vector<float> parameters(network.parameters), features(tile * inputs), d(tile * outputs);
    for (float& each : parameters) each = 0.1f * normal(random);
    for (float& each : features) each = normal(random);
    for (float& each : d) each = normal(random);
    std::vector<float> activations(tile * network.activations), scratch(activations.size()),
        rows(network.rows), gradient(network.parameters), eigen_gradient(network.parameters);
    WithEigen eigen;
    std::copy(features.begin(), features.end(), eigen.x.data());
    std::copy(d.begin(), d.end(), eigen.d_y.data());

    const auto own_forward = [&] {
        own.forward(network, parameters.data(), tile, features.data(), inputs, activations.data());
    };
    const auto own_both = [&] {
        own_forward();
        own.backward(network, rows.data(), tile, features.data(), inputs, activations.data(),
                     d.data(), scratch.data(), gradient.data(), nullptr);
    };
    const auto eigen_forward = [&] {
        eigen.forward(network, parameters.data());
    };
    const auto eigen_both = [&] {
        eigen_forward();
        eigen.backward(network, parameters.data(), eigen_gradient.data());
    };
    own.transpose(network, parameters.data(), rows.data());
    own_both();
    eigen_both();
    float difference = 0;
    for (std::size_t i = 0; i < gradient.size(); ++i)
        difference = std::max(difference, std::abs(gradient[i] - eigen_gradient[i]));
    std::printf("gradients differ by at most %.2g\n", static_cast<double>(difference));

    double least[4] = {1, 1, 1, 1};
    for (int repetition = 0; repetition < 200; ++repetition) {
        least[0] = std::min(least[0], seconds_of(own_forward, 100));
        least[1] = std::min(least[1], seconds_of(eigen_forward, 100));
        least[2] = std::min(least[2], seconds_of(own_both, 50));
        least[3] = std::min(least[3], seconds_of(eigen_both, 50));
    }
    const auto tell = [&](const char* what, double ours, double theirs) {
        std::printf("%-22s own %.3f us a sample, Eigen %.3f us: %.2f of the speed\n", what,
                    1e6 * ours / tile, 1e6 * theirs / tile, ours / theirs);
    };
    tell("forward", least[0], least[1]);
    tell("forward and backward", least[2], least[3]);
}
