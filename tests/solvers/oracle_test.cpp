// The networks' functions beside the same equations in Eigen's matrices: values, and gradients that
// are derived by hand. In double they agree to the last digits, in float as far as sums of floats
// do.
#include "solvers/network/gru.hpp"
#include "solvers/network/network.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

namespace rddlc::solvers::oracle {

// Includes the variants as network.cpp does, for doubles.
namespace in_double {
#define RDDL_VECTOR_BYTES 16
#define RDDL_WIDE_BYTES 16
#include "solvers/network/variant.hpp"
#undef RDDL_WIDE_BYTES
#undef RDDL_VECTOR_BYTES
}  // namespace in_double

namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Row = Eigen::RowVectorXd;

template <class Real>
const NetworkFunctions<Real>& functions_of_networks() {
    if constexpr (std::is_same_v<Real, float>)
        return network_functions();
    else
        return in_double::functions<double>;
}
template <class Real>
const GruFunctions<Real>& functions_of_grus() {
    if constexpr (std::is_same_v<Real, float>)
        return gru_functions();
    else
        return in_double::gru_functions_of<double>;
}

// The tolerance of sums of some hundred terms, and of the networks' own tanh, which is exact to a
// few digits.
template <class Real>
double tolerance(const Matrix& expected) {
    const double greatest = std::max(1.0, expected.cwiseAbs().maxCoeff());
    return 100 * static_cast<double>(std::numeric_limits<Real>::epsilon()) * greatest;
}

template <class Real>
void expect_near(const Matrix& found, const Matrix& expected, const char* what) {
    ASSERT_EQ(found.rows(), expected.rows()) << what;
    ASSERT_EQ(found.cols(), expected.cols()) << what;
    EXPECT_GT(expected.cwiseAbs().maxCoeff(), 1e-3) << what;
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), tolerance<Real>(expected)) << what;
}

Matrix random_matrix(int rows, int columns, std::mt19937& random, double scale = 1) {
    std::normal_distribution<double> normal(0, scale);
    return Matrix::NullaryExpr(
        rows, columns, [&] { return static_cast<double>(static_cast<float>(normal(random))); });
}

// Rows of `row` numbers, and their first columns.
template <class Real>
std::vector<Real> rows_of(const Matrix& matrix, int row) {
    std::vector<Real> all(static_cast<std::size_t>(matrix.rows() * row));
    for (int r = 0; r < matrix.rows(); ++r)
        for (int c = 0; c < matrix.cols(); ++c)
            all[static_cast<std::size_t>(r * row + c)] = static_cast<Real>(matrix(r, c));
    return all;
}
template <class Real>
Matrix matrix_of(const Real* numbers, int rows, int columns, int row) {
    return Matrix::NullaryExpr(rows, columns, [&](Eigen::Index r, Eigen::Index c) {
        return static_cast<double>(numbers[r * row + c]);
    });
}

template <class Real>
Matrix matrix_of(const Weights<Real>& weights) {
    return Matrix::NullaryExpr(
        weights.inputs, weights.outputs, [&](Eigen::Index i, Eigen::Index o) {
            return static_cast<double>(weights(static_cast<int>(i), static_cast<int>(o)));
        });
}
template <class Real>
void write(const Matrix& matrix, const Weights<Real>& weights) {
    for (int i = 0; i < weights.inputs; ++i)
        for (int o = 0; o < weights.outputs; ++o) weights(i, o) = static_cast<Real>(matrix(i, o));
}

// ------------------------------------------------------------------------------------ networks

struct Dense {
    Matrix weights, bias;  // the bias is a row
};

struct DenseNetwork {
    std::vector<Dense> layers;
    bool relu;

    // Inputs of each layer, and the results of the last one.
    std::vector<Matrix> forward(const Matrix& x) const {
        std::vector<Matrix> values = {x};
        for (const Dense& layer : layers) {
            Matrix next = (values.back() * layer.weights).rowwise() + Row(layer.bias.row(0));
            if (&layer != &layers.back())
                next = relu ? Matrix(next.cwiseMax(0.0)) : Matrix(next.array().tanh());
            values.push_back(next);
        }
        return values;
    }

    // Gradients of all layers, and by the inputs, in `d`.
    std::vector<Dense> backward(const std::vector<Matrix>& values, Matrix& d) const {
        std::vector<Dense> gradients(layers.size());
        for (std::size_t k = layers.size(); k-- > 0;) {
            const Matrix& x = values[k];
            gradients[k] = {x.transpose() * d, d.colwise().sum()};
            d = d * layers[k].weights.transpose();
            if (k == 0) break;
            d = relu ? Matrix(d.array() * (x.array() > 0).cast<double>())
                     : Matrix(d.array() * (1 - x.array().square()));
        }
        return gradients;
    }
};

template <class Real>
void compare(const Network& network, int count, int inner) {
    std::mt19937 random(static_cast<unsigned>(count));
    DenseNetwork dense{{}, network.activation == Activation::Relu};
    std::vector<Real> parameters(network.parameters);
    for (const Layer& layer : network.layers) {
        dense.layers.push_back({random_matrix(layer.inputs, layer.outputs, random, 0.5),
                                random_matrix(1, layer.outputs, random, 0.5)});
        write(dense.layers.back().weights, layer.weights_in(parameters.data()));
        for (int o = 0; o < layer.outputs; ++o)
            parameters[layer.bias + static_cast<std::size_t>(o)] =
                static_cast<Real>(dense.layers.back().bias(0, o));
    }
    const int inputs = network.inputs(), outputs = network.outputs();
    const Matrix x = random_matrix(count, inputs, random);
    const auto numbers = rows_of<Real>(x, inputs);
    const auto& functions = functions_of_networks<Real>();
    std::vector<Real> activations(network.activations * static_cast<std::size_t>(count));
    functions.forward(network, parameters.data(), count, numbers.data(), inputs,
                      activations.data());
    const std::vector<Matrix> values = dense.forward(x);
    const Real* const results =
        activations.data() + network.layers.back().values * static_cast<std::size_t>(count);
    expect_near<Real>(matrix_of(results, count, outputs, network.padded_outputs()), values.back(),
                      "results");

    Matrix d = random_matrix(count, outputs, random);
    const auto d_outputs = rows_of<Real>(d, network.padded_outputs());
    std::vector<Real> rows(network.rows), scratch(activations.size()), gradient(network.parameters);
    std::vector<Real> d_inner(static_cast<std::size_t>(count * padded(inner)));
    functions.transpose(network, parameters.data(), rows.data());
    functions.backward(network, rows.data(), count, numbers.data(), inputs, activations.data(),
                       d_outputs.data(), scratch.data(), gradient.data(), d_inner.data());
    const std::vector<Dense> expected = dense.backward(values, d);
    for (std::size_t k = 0; k < expected.size(); ++k) {
        const Layer& layer = network.layers[k];
        expect_near<Real>(matrix_of(layer.weights_in(gradient.data())), expected[k].weights,
                          "gradient by weights");
        expect_near<Real>(matrix_of(gradient.data() + layer.bias, 1, layer.outputs, 1),
                          expected[k].bias, "gradient by the bias");
    }
    expect_near<Real>(matrix_of(d_inner.data(), count, inner, padded(inner)), d.rightCols(inner),
                      "gradient by inner inputs");
}

TEST(Oracle, NetworksGoForwardAndBackwardAsEigenDoes) {
    for (const std::vector<int>& hidden :
         std::vector<std::vector<int>>{{}, {5}, {64, 64}, {13, 70, 9}})
        for (const int outputs : {1, 3, 17})
            for (const Activation activation : {Activation::Tanh, Activation::Relu})
                for (const int count : {1, 7, 64}) {
                    SCOPED_TRACE(testing::Message()
                                 << hidden.size() << " hidden layers, " << outputs << " outputs, "
                                 << name_of(activation) << ", " << count << " samples");
                    const Network network = make_network(6, hidden, outputs, 4, activation);
                    compare<double>(network, count, 4);
                    compare<float>(network, count, 4);
                }
}

// ---------------------------------------------------------------------- gated recurrent units

Matrix sigmoid(const Matrix& x) {
    return (1 + (-x.array()).exp()).inverse();
}

struct Part {
    Matrix input, state, bias;
};

// As in gru.hpp.
struct DenseGru {
    Part n, r, z;
    Matrix state_bias;  // cn

    struct Step {
        Matrix x, h, n, r, z, c;
    };

    // With what backward() needs; `h` becomes the state after it.
    Step forward(const Matrix& x, Matrix& h) const {
        const auto sum = [&](const Part& part) {
            return Matrix((x * part.input + h * part.state).rowwise() + Row(part.bias.row(0)));
        };
        Step step{x, h, {}, sigmoid(sum(r)), sigmoid(sum(z)), {}};
        step.c = (h * n.state).rowwise() + Row(state_bias.row(0));
        const Matrix of_input = (x * n.input).rowwise() + Row(n.bias.row(0));
        step.n = (of_input.array() + step.r.array() * step.c.array()).tanh();
        h = step.n.array() + step.z.array() * (h - step.n).array();
        return step;
    }

    // Adds to `gradient`; `d` is that by the state after the step, and becomes that by the one
    // before.
    void backward(const Step& s, Matrix& d, DenseGru& gradient) const {
        const auto add = [&](const Part& part, Part& to, const Matrix& d_sum) -> Matrix {
            to.input += s.x.transpose() * d_sum;
            to.bias += d_sum.colwise().sum();
            to.state += s.h.transpose() * d_sum;
            return d_sum * part.state.transpose();
        };
        const Matrix d_n =
            d.array() * (1 - s.z.array()) * (1 - s.n.array().square());  // by what tanh takes
        const Matrix d_z = d.array() * (s.h - s.n).array() * s.z.array() * (1 - s.z.array());
        const Matrix d_r = d_n.array() * s.c.array() * s.r.array() * (1 - s.r.array());
        const Matrix d_c = d_n.array() * s.r.array();
        gradient.n.input += s.x.transpose() * d_n;
        gradient.n.bias += d_n.colwise().sum();
        gradient.n.state += s.h.transpose() * d_c;
        gradient.state_bias += d_c.colwise().sum();
        d = d.cwiseProduct(s.z) + d_c * n.state.transpose();
        d += add(r, gradient.r, d_r);
        d += add(z, gradient.z, d_z);
    }
};

Part random_part(int inputs, int units, std::mt19937& random) {
    return {random_matrix(inputs, units, random, 0.7), random_matrix(units, units, random, 0.7),
            random_matrix(1, units, random, 0.7)};
}
Part zero_part(int inputs, int units) {
    return {Matrix::Zero(inputs, units), Matrix::Zero(units, units), Matrix::Zero(1, units)};
}

template <class Real>
void compare(const Gru& gru, const std::vector<int>& counts,
             const std::vector<std::uint8_t>& begins) {
    std::mt19937 random(11);
    const int units = gru.units, row = gru.padded_units, inputs = gru.inputs;
    const DenseGru dense{random_part(inputs, units, random), random_part(inputs, units, random),
                         random_part(inputs, units, random), random_matrix(1, units, random, 0.7)};
    const auto parts = gru_parts(gru);  // candidate, reset, update
    const auto part_of = [](auto& all, std::size_t k) -> auto& {
        return k == 0 ? all.n : k == 1 ? all.r : all.z;
    };
    std::vector<Real> parameters(gru.parameters);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        write(part_of(dense, k).input, input_weights(gru, parts[k], parameters.data()));
        write(part_of(dense, k).state, state_weights(gru, parts[k], parameters.data()));
        for (int u = 0; u < units; ++u)
            parameters[parts[k].bias + static_cast<std::size_t>(u)] =
                static_cast<Real>(part_of(dense, k).bias(0, u));
    }
    for (int u = 0; u < units; ++u)
        parameters[gru.state_bias() + static_cast<std::size_t>(u)] =
            static_cast<Real>(dense.state_bias(0, u));

    int rows = 0;
    for (const int count : counts) rows += count;
    const Matrix x = random_matrix(rows, inputs, random);
    const Matrix initial = random_matrix(counts[0], units, random, 0.5);
    const Matrix d_after = random_matrix(rows, units, random);

    // The result of Eigen.
    std::vector<DenseGru::Step> steps;
    Matrix h = initial, states(rows, units);
    for (int t = 0, first = 0; t < static_cast<int>(counts.size()); first += counts[t++]) {
        h.conservativeResize(counts[t], units);
        for (int r = 0; r < counts[t]; ++r)
            if (begins[static_cast<std::size_t>(first + r)]) h.row(r).setZero();
        steps.push_back(dense.forward(x.middleRows(first, counts[t]), h));
        states.middleRows(first, counts[t]) = h;
    }
    DenseGru expected{zero_part(inputs, units), zero_part(inputs, units), zero_part(inputs, units),
                      Matrix::Zero(1, units)};
    Matrix later = Matrix::Zero(counts.back(), units);  // by states that later steps begin with
    for (int t = static_cast<int>(counts.size()) - 1, end = rows; t >= 0; end -= counts[t--]) {
        Matrix d = d_after.middleRows(end - counts[t], counts[t]);
        d.topRows(later.rows()) += later;
        dense.backward(steps[static_cast<std::size_t>(t)], d, expected);
        for (int r = 0; r < counts[t]; ++r)
            if (begins[static_cast<std::size_t>(end - counts[t] + r)]) d.row(r).setZero();
        later = d;
    }

    const auto& functions = functions_of_grus<Real>();
    const auto size = static_cast<std::size_t>(rows * row);
    const auto numbers = rows_of<Real>(x, inputs), first_states = rows_of<Real>(initial, row);
    auto gradients_after = rows_of<Real>(d_after, row);
    std::vector<Real> before(size), after(size), scratch(first_states.size());
    std::vector<Real> values(static_cast<std::size_t>(rows * gru.values()));
    std::vector<Real> state_rows(gru.rows), gradient(gru.parameters);
    const Sequence sequence{counts, begins.data()};
    functions.forward(gru, parameters.data(), sequence, numbers.data(), inputs, first_states.data(),
                      before.data(), values.data(), after.data(), row);
    expect_near<Real>(matrix_of(after.data(), rows, units, row), states, "states");
    functions.transpose(gru, parameters.data(), state_rows.data());
    functions.backward(gru, state_rows.data(), sequence, numbers.data(), inputs, before.data(),
                       values.data(), gradients_after.data(), scratch.data(), gradient.data());
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const Part& part = part_of(expected, k);
        expect_near<Real>(matrix_of(input_weights(gru, parts[k], gradient.data())), part.input,
                          parts[k].name);
        expect_near<Real>(matrix_of(state_weights(gru, parts[k], gradient.data())), part.state,
                          parts[k].name);
        expect_near<Real>(matrix_of(gradient.data() + parts[k].bias, 1, units, 1), part.bias,
                          parts[k].name);
    }
    expect_near<Real>(matrix_of(gradient.data() + gru.state_bias(), 1, units, 1),
                      expected.state_bias, "cn");
}

TEST(Oracle, RecurrentUnitsGoThroughTimeAsEigenDoes) {
    const std::vector<int> counts = {5, 5, 5, 5, 2, 1};
    const std::vector<std::uint8_t> begins = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0,
                                              0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0};
    for (const auto& [inputs, units] : {std::pair{1, 1}, {3, 5}, {4, 8}, {2, 19}, {9, 64}}) {
        SCOPED_TRACE(testing::Message() << inputs << " inputs, " << units << " units");
        const Gru gru = make_gru(inputs, units);
        compare<double>(gru, counts, begins);
        compare<float>(gru, counts, begins);
    }
}

}  // namespace
}  // namespace rddlc::solvers::oracle
