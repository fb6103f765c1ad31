// Products of small matrices and activations, in the vector registers that RDDL_VECTOR_BYTES says.
// Long rows of both are done in those of RDDL_WIDE_BYTES, which are as large or larger:
// each number is computed in the same way, so it has the same bits.
//
// All matrices are row-major. Rows of results have a multiple of `padding` numbers, so that no loop
// has a rest. Each sum is made in the order of its terms, whatever the number of rows: so a
// sample's outputs do not depend on which others are computed with it.
//
// This file is included once for each instruction set, within a namespace of its own
// (variants.hpp): it includes nothing itself.

template <class Real, int bytes = RDDL_VECTOR_BYTES>
struct VectorOf {
    typedef Real Type __attribute__((vector_size(bytes), aligned(sizeof(Real))));
    static constexpr int width = bytes / static_cast<int>(sizeof(Real));
};
template <class Real, int bytes = RDDL_VECTOR_BYTES>
using Vector = typename VectorOf<Real, bytes>::Type;

template <int bytes = RDDL_VECTOR_BYTES, class Real>
inline Vector<Real, bytes> load(const Real* from) {
    return *reinterpret_cast<const Vector<Real, bytes>*>(from);
}
template <int bytes = RDDL_VECTOR_BYTES, class Real>
inline void store(Real* to, const Vector<Real, bytes>& values) {
    *reinterpret_cast<Vector<Real, bytes>*>(to) = values;
}

// A matrix whose element (r, k) is at row * r + step * k.
template <class Real>
struct Strided {
    const Real* data;
    std::ptrdiff_t row, step;
};

// `rows` x `vectors` vectors of the result stay in registers.
template <int rows, int vectors, bool adds, int bytes, class Real>
inline void product_block(int depth, Strided<Real> a, const Real* b, std::ptrdiff_t b_row, Real* c,
                          std::ptrdiff_t c_row) {
    constexpr int width = VectorOf<Real, bytes>::width;
    Vector<Real, bytes> sums[rows][vectors];
#pragma GCC unroll 16
    for (int r = 0; r < rows; ++r)
#pragma GCC unroll 4
        for (int v = 0; v < vectors; ++v)
            sums[r][v] = adds ? load<bytes>(c + r * c_row + v * width) : Vector<Real, bytes>{};
    for (int k = 0; k < depth; ++k) {
        Vector<Real, bytes> factors[vectors];
#pragma GCC unroll 4
        for (int v = 0; v < vectors; ++v) factors[v] = load<bytes>(b + k * b_row + v * width);
#pragma GCC unroll 16
        for (int r = 0; r < rows; ++r) {
            const Real factor = a.data[r * a.row + k * a.step];
#pragma GCC unroll 4
            for (int v = 0; v < vectors; ++v) sums[r][v] += factor * factors[v];
        }
    }
#pragma GCC unroll 16
    for (int r = 0; r < rows; ++r)
#pragma GCC unroll 4
        for (int v = 0; v < vectors; ++v) store<bytes>(c + r * c_row + v * width, sums[r][v]);
}

template <int vectors, bool adds, int bytes, class Real>
inline void product_columns(int rows, int depth, Strided<Real> a, const Real* b,
                            std::ptrdiff_t b_row, Real* c, std::ptrdiff_t c_row) {
    int r = 0;
    const auto at = [&](int row) {
        return Strided<Real>{a.data + row * a.row, a.row, a.step};
    };
    for (; r + 6 <= rows; r += 6)
        product_block<6, vectors, adds, bytes>(depth, at(r), b, b_row, c + r * c_row, c_row);
    for (; r + 4 <= rows; r += 4)
        product_block<4, vectors, adds, bytes>(depth, at(r), b, b_row, c + r * c_row, c_row);
    for (; r + 2 <= rows; r += 2)
        product_block<2, vectors, adds, bytes>(depth, at(r), b, b_row, c + r * c_row, c_row);
    if (r < rows)
        product_block<1, vectors, adds, bytes>(depth, at(r), b, b_row, c + r * c_row, c_row);
}

// c (+)= a b, where a is rows x depth and b depth x columns.
template <bool adds, class Real>
inline void product(int rows, int columns, int depth, Strided<Real> a, const Real* b,
                    std::ptrdiff_t b_row, Real* c, std::ptrdiff_t c_row) {
    constexpr int width = VectorOf<Real>::width, wide = VectorOf<Real, RDDL_WIDE_BYTES>::width;
    int j = 0;
    for (; j + 2 * wide <= columns; j += 2 * wide)
        product_columns<2, adds, RDDL_WIDE_BYTES>(rows, depth, a, b + j, b_row, c + j, c_row);
    if constexpr (wide > width)
        for (; j + 2 * width <= columns; j += 2 * width)
            product_columns<2, adds, RDDL_VECTOR_BYTES>(rows, depth, a, b + j, b_row, c + j, c_row);
    for (; j < columns; j += width)
        product_columns<1, adds, RDDL_VECTOR_BYTES>(rows, depth, a, b + j, b_row, c + j, c_row);
}

template <int bytes = RDDL_VECTOR_BYTES>
inline Vector<double, bytes> tanh_of(Vector<double, bytes> x) {
    for (int i = 0; i < VectorOf<double, bytes>::width; ++i) x[i] = __builtin_tanh(x[i]);
    return x;
}

// x p(x^2) / q(x^2), beyond 8 as at 8: to 3.4e-7 of the value, and never beyond 1. The numbers are
// from docs/mathematics/tanh_of_networks.py.
template <int bytes = RDDL_VECTOR_BYTES>
inline Vector<float, bytes> tanh_of(Vector<float, bytes> x) {
    using Floats = Vector<float, bytes>;
    constexpr float most = 8;
    x = x > most ? Floats{} + most : x;
    x = x < -most ? Floats{} - most : x;
    const Floats square = x * x;
    Floats p = square * 1.52304143e-08f + 2.18946589e-05f;
    p = p * square + 0.00357159786f;
    p = p * square + 0.134444982f;
    p = p * square + 1.f;
    Floats q = square * 8.52244511e-07f + 0.000341129169f;
    q = q * square + 0.0261644423f;
    q = q * square + 0.467778265f;
    q = q * square + 1.f;
    return x * p / q;
}

// What ends a layer: h = value(sum), and what becomes of a derivative d by h. All map 0 to 0, so
// padding stays 0, and what is no number to what is none.
struct Linear {
    template <class Real, int bytes>
    static Vector<Real, bytes> value(Vector<Real, bytes> sum) {
        return sum;
    }
};
struct Tanh {
    template <class Real, int bytes>
    static Vector<Real, bytes> value(Vector<Real, bytes> sum) {
        return tanh_of<bytes>(sum);
    }
    template <class Real>
    static Vector<Real> derivative(Vector<Real> h, Vector<Real> d) {
        return d * (Real(1) - h * h);
    }
};
struct Relu {
    template <class Real, int bytes>
    static Vector<Real, bytes> value(Vector<Real, bytes> sum) {
        return sum < Real(0) ? Vector<Real, bytes>{} : sum;
    }
    template <class Real>
    static Vector<Real> derivative(Vector<Real> h, Vector<Real> d) {
        return h > Real(0) ? d : Vector<Real>{};
    }
};

template <class End, int bytes, class Real>
inline void add_bias_at(int c, const Real* bias, Real* x) {
    const Vector<Real, bytes> sum = load<bytes>(x + c) + load<bytes>(bias + c);
    store<bytes>(x + c, End::template value<Real, bytes>(sum));
}

// Rows of `columns` numbers: x = End::value(x + bias).
template <class End, class Real>
inline void add_bias(int rows, int columns, const Real* bias, Real* x) {
    constexpr int width = VectorOf<Real>::width, wide = VectorOf<Real, RDDL_WIDE_BYTES>::width;
    for (int r = 0; r < rows; ++r, x += columns) {
        int c = 0;
        for (; c + wide <= columns; c += wide) add_bias_at<End, RDDL_WIDE_BYTES>(c, bias, x);
        if constexpr (wide > width)
            for (; c < columns; c += width) add_bias_at<End, RDDL_VECTOR_BYTES>(c, bias, x);
    }
}

// d *= the derivative of h = End::value.
template <class End, class Real>
inline void times_derivative(int count, const Real* h, Real* d) {
    for (int i = 0; i < count; i += VectorOf<Real>::width)
        store(d + i, End::template derivative<Real>(load(h + i), load(d + i)));
}

template <class Real>
inline void add_rows(int rows, int columns, const Real* x, Real* sums) {
    for (int r = 0; r < rows; ++r, x += columns)
        for (int c = 0; c < columns; c += VectorOf<Real>::width)
            store(sums + c, load(sums + c) + load(x + c));
}
