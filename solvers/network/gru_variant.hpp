// GruFunctions for one instruction set. Included by variant.hpp, whose kernels it uses; includes
// nothing itself.

template <class Real>
inline Vector<Real> sigmoid_of(const Vector<Real>& x) {
    return tanh_of(x * Real(0.5)) * Real(0.5) + Real(0.5);
}

template <class Real>
void gru_step(const Gru& gru, const Real* parameters, int count, const Real* x, int x_row,
              const Real* before, Real* values, Real* after, int after_row) {
    const int units = gru.padded_units, row = gru.values();
    const Real* const bias = parameters + gru.bias;
    for (int s = 0; s < count; ++s)
        for (int v = 0; v < row; v += VectorOf<Real>::width)
            store(values + s * row + v, load(bias + v));
    product(count, 3 * units, gru.inputs, Strided<Real>{x, x_row, 1},
            parameters + gru.input_weights, 3 * units, Added<Real>{values, row});
    product(count, 3 * units, gru.units, Strided<Real>{before, units, 1},
            parameters + gru.state_weights, 3 * units, Added<Real>{values + units, row});
    for (int s = 0; s < count; ++s)
        for (int u = 0; u < units; u += VectorOf<Real>::width) {
            Real* const part = values + s * row + u;
            const Vector<Real> reset = sigmoid_of<Real>(load(part + units));
            const Vector<Real> update = sigmoid_of<Real>(load(part + 2 * units));
            const Vector<Real> read = load(part + 3 * units);
            const Vector<Real> candidate = tanh_of(load(part) + reset * read);
            store(part, candidate);
            store(part + units, reset);
            store(part + 2 * units, update);
            const Vector<Real> old = load(before + s * units + u);
            store(after + s * after_row + u, candidate + update * (old - candidate));
        }
}

template <class Real>
void gru_forward(const Gru& gru, const Real* parameters, const Sequence& sequence, const Real* x,
                 int x_row, const Real* initial, Real* before, Real* values, Real* after,
                 int after_row) {
    const int units = gru.padded_units;
    const std::uint8_t* begins = sequence.begins;
    const Real* last = initial;
    int last_row = units;
    for (std::size_t t = 0; t < sequence.counts.size(); ++t) {
        const int count = sequence.counts[t];
        for (int s = 0; s < count; ++s)
            for (int u = 0; u < units; u += VectorOf<Real>::width)
                store(before + s * units + u,
                      begins[s] ? Vector<Real>{} : load(last + s * last_row + u));
        gru_step(gru, parameters, count, x, x_row, before, values, after, after_row);
        last = after;
        last_row = after_row;
        begins += count;
        x += count * x_row;
        before += count * units;
        values += count * gru.values();
        after += count * after_row;
    }
}

// The backward pass of one step: the gradients by the four parts before their functions take the
// place of the parts, and those by the states before it are written.
template <class Real>
void gru_step_back(const Gru& gru, const Real* rows, int count, const Real* before, Real* values,
                   const Real* d_after, Real* d_before) {
    const int units = gru.padded_units, row = gru.values();
    for (int s = 0; s < count; ++s)
        for (int u = 0; u < units; u += VectorOf<Real>::width) {
            Real* const part = values + s * row + u;
            const Vector<Real> candidate = load(part), reset = load(part + units);
            const Vector<Real> update = load(part + 2 * units), read = load(part + 3 * units);
            const Vector<Real> old = load(before + s * units + u);
            const Vector<Real> d = load(d_after + s * units + u);
            const Vector<Real> d_candidate =
                d * (Real(1) - update) * (Real(1) - candidate * candidate);
            store(part, d_candidate);
            store(part + units, d_candidate * read * reset * (Real(1) - reset));
            store(part + 2 * units, d * (old - candidate) * update * (Real(1) - update));
            store(part + 3 * units, d_candidate * reset);
            store(d_before + s * units + u, d * update);
        }
    product(count, units, 3 * units, Strided<Real>{values + units, row, 1}, rows, units,
            Added<Real>{d_before, units});
}

template <class Real>
void gru_backward(const Gru& gru, const Real* rows, const Sequence& sequence, const Real* x,
                  int x_row, const Real* before, Real* values, Real* d_after, Real* scratch,
                  Real* gradient) {
    const int units = gru.padded_units, row = gru.values();
    int all = 0;
    for (const int count : sequence.counts) all += count;
    int first = all;
    for (std::size_t t = sequence.counts.size(); t-- > 0;) {
        const int count = sequence.counts[t];
        first -= count;
        gru_step_back(gru, rows, count, before + first * units, values + first * row,
                      d_after + first * units, scratch);
        if (t == 0) break;
        Real* const d_last = d_after + (first - sequence.counts[t - 1]) * units;
        for (int s = 0; s < count; ++s)
            if (!sequence.begins[first + s])
                add_rows(1, units, scratch + s * units, d_last + s * units);
    }
    product(gru.inputs, 3 * units, all, Strided<Real>{x, 1, x_row}, values, row,
            Added<Real>{gradient + gru.input_weights, 3 * units});
    product(gru.units, 3 * units, all, Strided<Real>{before, 1, units}, values + units, row,
            Added<Real>{gradient + gru.state_weights, 3 * units});
    add_rows(all, row, values, gradient + gru.bias);
}

template <class Real>
void gru_transpose(const Gru& gru, const Real* parameters, Real* rows) {
    const int columns = 3 * gru.padded_units;
    const Real* const from = parameters + gru.state_weights;
    for (int c = 0; c < columns; ++c)
        for (int u = 0; u < gru.units; ++u) rows[c * gru.padded_units + u] = from[u * columns + c];
}

template <class Real>
constexpr GruFunctions<Real> gru_functions_of{gru_step<Real>, gru_forward<Real>, gru_backward<Real>,
                                              gru_transpose<Real>};
