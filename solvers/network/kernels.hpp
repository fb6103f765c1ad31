// Products of small matrices and activations, in the vector registers that RDDL_VECTOR_BYTES says.
// Long rows of both are done in those of RDDL_WIDE_BYTES, which are as large or larger:
// each number is computed in the same way, so it has the same bits.
//
// All matrices are row-major. Rows of results have a multiple of `padding` numbers, so that no loop
// has a rest. The order of a sum's terms is the same whatever the number of rows: so a sample's
// outputs do not depend on which others are computed with it.
//
// This file is included once for each instruction set, within a namespace of its own
// (variant.hpp): it includes nothing itself.

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
inline void store(Real* to, Vector<Real, bytes> values) {
    *reinterpret_cast<Vector<Real, bytes>*>(to) = values;
}

// A matrix whose element (r, k) is at row * r + step * k.
template <class Real>
struct Strided {
    const Real* data;
    std::ptrdiff_t row, step;
};

// The destination of a product's sums: the sum at row r and column c begins with begin(r, c), and
// end(r, c, sum) stores it, or a function of it, from the register. This one adds to a matrix.
template <class Real>
struct Added {
    Real* to;
    std::ptrdiff_t row;

    template <int bytes>
    Vector<Real, bytes> begin(int r, int c) const {
        return load<bytes>(to + r * row + c);
    }
    template <int bytes>
    void end(int r, int c, Vector<Real, bytes> sum) const {
        store<bytes>(to + r * row + c, sum);
    }
};

// Keeps `rows` x `vectors` vectors of sums, from row r and column c on, in registers. As a call of
// a function it would take a tenth longer.
template <int rows, int vectors, int bytes, class Real, class Sums>
[[gnu::always_inline]] inline void product_block(int r, int c, int depth, Strided<Real> a,
                                                 const Real* b, std::ptrdiff_t b_row,
                                                 const Sums& sums) {
    constexpr int width = VectorOf<Real, bytes>::width;
    a.data += r * a.row;
    b += c;
    Vector<Real, bytes> block[rows][vectors];
#pragma GCC unroll 16
    for (int i = 0; i < rows; ++i)
#pragma GCC unroll 4
        for (int v = 0; v < vectors; ++v)
            block[i][v] = sums.template begin<bytes>(r + i, c + v * width);
    for (int k = 0; k < depth; ++k) {
        Vector<Real, bytes> factors[vectors];
#pragma GCC unroll 4
        for (int v = 0; v < vectors; ++v) factors[v] = load<bytes>(b + k * b_row + v * width);
#pragma GCC unroll 16
        for (int i = 0; i < rows; ++i) {
            const Real factor = a.data[i * a.row + k * a.step];
#pragma GCC unroll 4
            for (int v = 0; v < vectors; ++v) block[i][v] += factor * factors[v];
        }
    }
#pragma GCC unroll 16
    for (int i = 0; i < rows; ++i)
#pragma GCC unroll 4
        for (int v = 0; v < vectors; ++v)
            sums.template end<bytes>(r + i, c + v * width, block[i][v]);
}

// A multiply-add begins before the last one has ended, but not the one that adds to the same sum.
// So many sums at a time keep the processor busy, and leave registers for the factors.
template <int vectors, int bytes, class Real, class Sums>
inline void product_columns(int rows, int c, int depth, Strided<Real> a, const Real* b,
                            std::ptrdiff_t b_row, const Sums& sums) {
    constexpr int most = vectors == 4 ? 4 : 6;
    int r = 0;
    for (; r + most <= rows; r += most)
        product_block<most, vectors, bytes>(r, c, depth, a, b, b_row, sums);
    if constexpr (most > 4)
        for (; r + 4 <= rows; r += 4)
            product_block<4, vectors, bytes>(r, c, depth, a, b, b_row, sums);
    for (; r + 2 <= rows; r += 2) product_block<2, vectors, bytes>(r, c, depth, a, b, b_row, sums);
    if (r < rows) product_block<1, vectors, bytes>(r, c, depth, a, b, b_row, sums);
}

// a b, where a is rows x depth and b depth x columns.
template <class Real, class Sums>
inline void product(int rows, int columns, int depth, Strided<Real> a, const Real* b,
                    std::ptrdiff_t b_row, const Sums& sums) {
    constexpr int width = VectorOf<Real>::width, wide = VectorOf<Real, RDDL_WIDE_BYTES>::width;
    int c = 0;
    if constexpr (wide > width) {  // there are also twice as many registers
        for (; c + 4 * wide <= columns; c += 4 * wide)
            product_columns<4, RDDL_WIDE_BYTES>(rows, c, depth, a, b, b_row, sums);
        for (; c + 2 * wide <= columns; c += 2 * wide)
            product_columns<2, RDDL_WIDE_BYTES>(rows, c, depth, a, b, b_row, sums);
    }
    for (; c + 2 * width <= columns; c += 2 * width)
        product_columns<2, RDDL_VECTOR_BYTES>(rows, c, depth, a, b, b_row, sums);
    for (; c < columns; c += width)
        product_columns<1, RDDL_VECTOR_BYTES>(rows, c, depth, a, b, b_row, sums);
}

// The sum of a[k] b[k]; `count` is a multiple of the padding.
template <class Real>
inline Real dot_product(int count, const Real* a, const Real* b) {
    Vector<Real> sums{};
    for (int k = 0; k < count; k += VectorOf<Real>::width) sums += load(a + k) * load(b + k);
    Real all = 0;
    for (int i = 0; i < VectorOf<Real>::width; ++i) all += sums[i];
    return all;
}

// The results of a layer of few outputs: x w + bias, where w has a row of `inputs` numbers for each
// output. The padding of rows of results becomes 0.
template <class Real>
inline void few_results(int count, int inputs, int outputs, const Real* x, const Real* w,
                        const Real* bias, Real* to, int row) {
    for (int s = 0; s < count; ++s, x += inputs, to += row)
        for (int o = 0; o < row; ++o)
            to[o] = o < outputs ? dot_product(inputs, x, w + o * inputs) + bias[o] : Real(0);
}

// sums += the rows of x.
template <class Real>
inline void add_rows(int rows, int columns, const Real* x, Real* sums) {
    constexpr Real one = 1;
    product(1, columns, rows, Strided<Real>{&one, 0, 0}, x, columns, Added<Real>{sums, 0});
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

// The end of a layer: h = value(sum), and the derivative by h. All functions map 0 to 0, so padding
// stays 0, and map nan to nan.
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
    template <class Real, int bytes>
    static Vector<Real, bytes> derivative(Vector<Real, bytes> h, Vector<Real, bytes> d) {
        return d * (Real(1) - h * h);
    }
};
struct Relu {
    template <class Real, int bytes>
    static Vector<Real, bytes> value(Vector<Real, bytes> sum) {
        return sum < Real(0) ? Vector<Real, bytes>{} : sum;
    }
    template <class Real, int bytes>
    static Vector<Real, bytes> derivative(Vector<Real, bytes> h, Vector<Real, bytes> d) {
        return h > Real(0) ? d : Vector<Real, bytes>{};
    }
};

// Sums of a layer's inputs become its results.
template <class End, class Real>
struct Results {
    const Real* bias;
    Real* to;
    std::ptrdiff_t row;

    template <int bytes>
    Vector<Real, bytes> begin(int, int c) const {
        return load<bytes>(bias + c);
    }
    template <int bytes>
    void end(int r, int c, Vector<Real, bytes> sum) const {
        store<bytes>(to + r * row + c, End::template value<Real, bytes>(sum));
    }
};

// Derivatives by a layer's results h become those by the sums that they were made of.
template <class End, class Real>
struct Derivatives {
    const Real* h;
    Real* to;
    std::ptrdiff_t row;  // of both

    template <int bytes>
    Vector<Real, bytes> begin(int, int) const {
        return Vector<Real, bytes>{};
    }
    template <int bytes>
    void end(int r, int c, Vector<Real, bytes> d) const {
        const std::ptrdiff_t at = r * row + c;
        store<bytes>(to + at, End::template derivative<Real, bytes>(load<bytes>(h + at), d));
    }
};
