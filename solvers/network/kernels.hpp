// Products of small matrices and tanh, in the vector registers that RDDL_VECTOR_BYTES says.
//
// All matrices are row-major. Rows of results have a multiple of `padding` numbers, so that no loop
// has a rest. Each sum is made in the order of its terms, whatever the number of rows: so a
// sample's outputs do not depend on which others are computed with it.
//
// This file is included once for each instruction set, within a namespace of its own
// (variants.hpp): it includes nothing itself.

template <class Real>
struct VectorOf {
    typedef Real Type __attribute__((vector_size(RDDL_VECTOR_BYTES), aligned(sizeof(Real))));
    static constexpr int width = RDDL_VECTOR_BYTES / static_cast<int>(sizeof(Real));
};
template <class Real>
using Vector = typename VectorOf<Real>::Type;

template <class Real>
inline Vector<Real> load(const Real* from) {
    return *reinterpret_cast<const Vector<Real>*>(from);
}
template <class Real>
inline void store(Real* to, const Vector<Real>& values) {
    *reinterpret_cast<Vector<Real>*>(to) = values;
}

// A matrix whose element (r, k) is at row * r + step * k.
template <class Real>
struct Strided {
    const Real* data;
    std::ptrdiff_t row, step;
};

// `rows` x `vectors` vectors of the result stay in registers.
template <int rows, int vectors, bool adds, class Real>
inline void product_block(int depth, Strided<Real> a, const Real* b, std::ptrdiff_t b_row, Real* c,
                          std::ptrdiff_t c_row) {
    constexpr int width = VectorOf<Real>::width;
    Vector<Real> sums[rows][vectors];
#pragma GCC unroll 16
    for (int r = 0; r < rows; ++r)
#pragma GCC unroll 4
        for (int v = 0; v < vectors; ++v)
            sums[r][v] = adds ? load(c + r * c_row + v * width) : Vector<Real>{};
    for (int k = 0; k < depth; ++k) {
        Vector<Real> factors[vectors];
#pragma GCC unroll 4
        for (int v = 0; v < vectors; ++v) factors[v] = load(b + k * b_row + v * width);
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
        for (int v = 0; v < vectors; ++v) store(c + r * c_row + v * width, sums[r][v]);
}

template <int vectors, bool adds, class Real>
inline void product_columns(int rows, int depth, Strided<Real> a, const Real* b,
                            std::ptrdiff_t b_row, Real* c, std::ptrdiff_t c_row) {
    int r = 0;
    const auto at = [&](int row) {
        return Strided<Real>{a.data + row * a.row, a.row, a.step};
    };
    for (; r + 6 <= rows; r += 6)
        product_block<6, vectors, adds>(depth, at(r), b, b_row, c + r * c_row, c_row);
    for (; r + 4 <= rows; r += 4)
        product_block<4, vectors, adds>(depth, at(r), b, b_row, c + r * c_row, c_row);
    for (; r + 2 <= rows; r += 2)
        product_block<2, vectors, adds>(depth, at(r), b, b_row, c + r * c_row, c_row);
    if (r < rows) product_block<1, vectors, adds>(depth, at(r), b, b_row, c + r * c_row, c_row);
}

// c (+)= a b, where a is rows x depth and b depth x columns.
template <bool adds, class Real>
inline void product(int rows, int columns, int depth, Strided<Real> a, const Real* b,
                    std::ptrdiff_t b_row, Real* c, std::ptrdiff_t c_row) {
    constexpr int width = VectorOf<Real>::width;
    int j = 0;
    for (; j + 2 * width <= columns; j += 2 * width)
        product_columns<2, adds>(rows, depth, a, b + j, b_row, c + j, c_row);
    for (; j < columns; j += width)
        product_columns<1, adds>(rows, depth, a, b + j, b_row, c + j, c_row);
}

inline Vector<double> tanh_of(Vector<double> x) {
    for (int i = 0; i < VectorOf<double>::width; ++i) x[i] = __builtin_tanh(x[i]);
    return x;
}

// (e^2x - 1) / (e^2x + 1), from e^2x - 1 = 2^n (e^r - 1) + 2^n - 1, where e^r - 1 is a sum of
// powers: precise to a few units of the last digit, about 0, too.
inline Vector<float> tanh_of(Vector<float> x) {
    using Ints = int __attribute__((vector_size(RDDL_VECTOR_BYTES)));
    constexpr float most = 9.1f;  // where tanh is 1
    constexpr float magic = 0x1.8p23f, log2e = 1.44269504f;
    constexpr float ln2_high = 0.693359375f, ln2_low = -2.12194440e-4f;
    x = x > most ? Vector<float>{} + most : x;
    x = x < -most ? Vector<float>{} - most : x;
    const Vector<float> y = x + x;
    const Vector<float> shifted = y * log2e + magic;
    const Vector<float> n = shifted - magic;
    const Vector<float> r = (y - n * ln2_high) - n * ln2_low;
    Vector<float> p = r * (1 / 5040.f) + 1 / 720.f;
    p = p * r + 1 / 120.f;
    p = p * r + 1 / 24.f;
    p = p * r + 1 / 6.f;
    p = p * r + 0.5f;
    p = p * r * r + r;
    const Ints exponent = ((Ints)shifted << 23) + 0x3F800000;
    const Vector<float> power = (Vector<float>)exponent;
    const Vector<float> m = power * p + (power - 1.f);
    return m / (m + 2.f);
}

// Rows of `columns` numbers: x = tanh(x + bias), or x + bias.
template <bool squashes, class Real>
inline void add_bias(int rows, int columns, const Real* bias, Real* x) {
    constexpr int width = VectorOf<Real>::width;
    for (int r = 0; r < rows; ++r, x += columns)
        for (int c = 0; c < columns; c += width) {
            const Vector<Real> sum = load(x + c) + load(bias + c);
            store(x + c, squashes ? tanh_of(sum) : sum);
        }
}

// d *= 1 - h^2, the derivative of h = tanh.
template <class Real>
inline void times_derivative(int count, const Real* h, Real* d) {
    for (int i = 0; i < count; i += VectorOf<Real>::width) {
        const Vector<Real> value = load(h + i);
        store(d + i, load(d + i) * (Real(1) - value * value));
    }
}

template <class Real>
inline void add_rows(int rows, int columns, const Real* x, Real* sums) {
    for (int r = 0; r < rows; ++r, x += columns)
        for (int c = 0; c < columns; c += VectorOf<Real>::width)
            store(sums + c, load(sums + c) + load(x + c));
}
