// A layer of gated recurrent units, which remembers: K. Cho et al., "Learning phrase
// representations using RNN encoder-decoder for statistical machine translation", 2014, in the form
// that PyTorch and ONNX (linear_before_reset = 1) have:
//
//   r = s(Wr x + br + Ur h)         what of its old state h the candidate reads; s is the sigmoid
//   z = s(Wz x + bz + Uz h)         what of it stays
//   n = tanh(Wn x + bn + r * (Un h + cn))
//   h' = n + z * (h - n)
//
// Parameters are one array: for each input a row of the columns of Wn, Wr, Wz; for each unit a row
// of those of Ur, Uz, Un; then bn, br, bz, cn. Each of these parts has padded_units numbers. So
// what is computed of a sample is a row of four parts, n, r, z and Un h + cn: inputs add to the
// first three of them, the old state to the last three. What pads is 0 and stays so.
#pragma once

#include "solvers/network/network.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rddlc::solvers {

struct Gru {
    int inputs = 0, units = 0;  // 0 units: no memory
    int padded_units = 0;
    std::size_t input_weights = 0, state_weights = 0, bias = 0;  // where they begin
    std::size_t parameters = 0;                                  // numbers
    std::size_t rows = 0;  // numbers: U as [column][padded unit], for backward()
    // Numbers of a sample's parts, and of a row of weights.
    int values() const { return 4 * padded_units; }
    int weight_row() const { return 3 * padded_units; }
    // The place of cn.
    std::size_t state_bias() const { return bias + static_cast<std::size_t>(weight_row()); }
};

// The places of the parameters of n, r and z; cn is not among them.
struct GruPart {
    const char* name;
    std::size_t input_weights, state_weights, bias;
};
inline std::array<GruPart, 3> gru_parts(const Gru& gru) {
    const auto part = [&gru](const char* name, int of_inputs, int of_state) -> GruPart {
        const auto first = static_cast<std::size_t>(of_inputs * gru.padded_units);
        const auto other = static_cast<std::size_t>(of_state * gru.padded_units);
        return {name, gru.input_weights + first, gru.state_weights + other, gru.bias + first};
    };
    return {part("candidate", 0, 2), part("reset", 1, 0), part("update", 2, 1)};
}

// The weights of a part from the inputs, and those from the old state.
template <class Real>
Weights<Real> input_weights(const Gru& gru, const GruPart& part, Real* parameters) {
    return {parameters + part.input_weights, gru.inputs, gru.units, gru.weight_row(), 1};
}
template <class Real>
Weights<Real> state_weights(const Gru& gru, const GruPart& part, Real* parameters) {
    return {parameters + part.state_weights, gru.units, gru.units, gru.weight_row(), 1};
}

Gru make_gru(int inputs, int units);

// Steps of several samples side by side, in the order of the steps. Row r of a step continues row r
// of the step before.
struct Sequence {
    std::span<const int> counts;  // rows of each step, never more than of the step before
    const std::uint8_t* begins;   // of each row; 1: there is nothing to remember
};

// The functions of one instruction set. `x` has rows of `x_row` numbers, `after` of `after_row`,
// all others are padded: states have padded_units numbers.
template <class Real>
struct GruFunctions {
    // One step: the states `after` it, given those `before` it.
    void (*step)(const Gru&, const Real* parameters, int count, const Real* x, int x_row,
                 const Real* before, Real* values, Real* after, int after_row);
    // All steps, from the states `initial` of the first step's rows on; writes what each began with
    // into `before`.
    void (*forward)(const Gru&, const Real* parameters, const Sequence&, const Real* x, int x_row,
                    const Real* initial, Real* before, Real* values, Real* after, int after_row);
    // Adds the gradient by the parameters to `gradient`, given that by the states after each step,
    // as far as others than later steps depend on them, in `d_after`. Changes that, and `values`.
    // `rows` is what transpose() has made; `scratch` has the size of the first step's states.
    void (*backward)(const Gru&, const Real* rows, const Sequence&, const Real* x, int x_row,
                     const Real* before, Real* values, Real* d_after, Real* scratch,
                     Real* gradient);
    // U as rows.
    void (*transpose)(const Gru&, const Real* parameters, Real* rows);
};

// The functions for this processor, as network_functions().
const GruFunctions<float>& gru_functions();

}  // namespace rddlc::solvers
