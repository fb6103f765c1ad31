// The functions that kernel.hpp needs, for each of the compared libraries. main.cpp includes their
// headers.
#pragma once

inline constexpr std::uint64_t bits_of_one = 0x3FF0000000000000;

template <std::size_t width>
std::array<std::uint64_t, width> numbers_from(std::size_t first) {
    std::array<std::uint64_t, width> numbers;
    for (std::size_t i = 0; i < width; ++i) numbers[i] = first + i;
    return numbers;
}

struct Ours {
    static constexpr std::size_t width = rddl::simd::lanes < 8 ? 8 : rddl::simd::lanes;
    using Lane = rddl::Pack<static_cast<int>(width)>;
    using Real = Lane::Real;
    using Word = Lane::Word;
    using Mask = Lane::Bool;
    static Real real(double a) { return a; }
    static Word word(std::uint64_t a) { return a; }
    static Word counting(std::size_t first) {
        return Word::load(numbers_from<width>(first).data());
    }
    static Real load(const double* from) { return Real::load(from); }
    static void store(Real a, double* to) { a.store(to); }
    static Word multiply_low_halves(Word a, Word b) { return rddl::multiply_low_halves(a, b); }
    static Word high_half(Word a) { return a >> 32; }
    static Real unit_real(Word a) {
        return rddl::real_of_bits((a >> 12) | word(bits_of_one)) - real(1);
    }
    static Mask less(Real a, Real b) { return a < b; }
    static Real select(Mask mask, Real a, Real b) { return rddl::select(mask, a, b); }
    static Real gather(const double* from, Word indices) {
        const auto ints = rddl::ints_of(indices);
        return Real::each([from](auto part) { return rddl::simd::gather(from, part); }, ints);
    }
};

struct Xsimd {
    using Real = xsimd::batch<double>;
    using Word = xsimd::batch<std::uint64_t>;
    using Mask = Real::batch_bool_type;
    static constexpr std::size_t width = Real::size;
    static Real real(double a) { return a; }
    static Word word(std::uint64_t a) { return a; }
    static Word counting(std::size_t first) {
        return Word::load_unaligned(numbers_from<width>(first).data());
    }
    static Real load(const double* from) { return Real::load_unaligned(from); }
    static void store(Real a, double* to) { a.store_unaligned(to); }
    static Word multiply_low_halves(Word a, Word b) {
        return (a & word(0xFFFFFFFF)) * (b & word(0xFFFFFFFF));
    }
    static Word high_half(Word a) { return a >> 32; }
    static Real unit_real(Word a) {
        return xsimd::bitwise_cast<Real>((a >> 12) | word(bits_of_one)) - real(1);
    }
    static Mask less(Real a, Real b) { return a < b; }
    static Real select(Mask mask, Real a, Real b) { return xsimd::select(mask, a, b); }
    static Real gather(const double* from, Word indices) {  // 8.1 has no gather
        std::uint64_t at[width];
        double values[width];
        indices.store_unaligned(at);
        for (std::size_t i = 0; i < width; ++i) values[i] = from[at[i]];
        return load(values);
    }
};

struct Experimental {
    using Real = std::experimental::native_simd<double>;
    using Word = std::experimental::rebind_simd_t<std::uint64_t, Real>;
    using Mask = Real::mask_type;
    static constexpr std::size_t width = Real::size();
    static Real real(double a) { return a; }
    static Word word(std::uint64_t a) { return a; }
    static Word counting(std::size_t first) {
        return Word([first](auto i) { return std::uint64_t{first + i}; });
    }
    static Real load(const double* from) { return Real(from, std::experimental::element_aligned); }
    static void store(Real a, double* to) { a.copy_to(to, std::experimental::element_aligned); }
    static Word multiply_low_halves(Word a, Word b) {
        return (a & word(0xFFFFFFFF)) * (b & word(0xFFFFFFFF));
    }
    static Word high_half(Word a) { return a >> 32; }
    static Real unit_real(Word a) {
        return std::bit_cast<Real>((a >> 12) | word(bits_of_one)) - real(1);
    }
    static Mask less(Real a, Real b) { return a < b; }
    static Real select(Mask mask, Real a, Real b) {
        where(mask, b) = a;
        return b;
    }
    static Real gather(const double* from, Word indices) {  // has no gather
        return Real([&](auto i) { return from[indices[i]]; });
    }
};

struct Highway {
    using Reals = hwy::HWY_NAMESPACE::ScalableTag<double>;
    using Words = hwy::HWY_NAMESPACE::ScalableTag<std::uint64_t>;
    using Real = hwy::HWY_NAMESPACE::Vec<Reals>;
    using Word = hwy::HWY_NAMESPACE::Vec<Words>;
    using Mask = hwy::HWY_NAMESPACE::Mask<Reals>;
    static constexpr std::size_t width = HWY_LANES(double);
    static Real real(double a) { return Set(Reals(), a); }
    static Word word(std::uint64_t a) { return Set(Words(), a); }
    static Word counting(std::size_t first) { return Iota(Words(), first); }
    static Real load(const double* from) { return LoadU(Reals(), from); }
    static void store(Real a, double* to) { StoreU(a, Reals(), to); }
    static Word multiply_low_halves(Word a, Word b) {
        constexpr hwy::HWY_NAMESPACE::Repartition<std::uint32_t, Words> halves;
        return MulEven(BitCast(halves, a), BitCast(halves, b));
    }
    static Word high_half(Word a) { return hwy::HWY_NAMESPACE::ShiftRight<32>(a); }
    static Real unit_real(Word a) {
        return BitCast(Reals(), hwy::HWY_NAMESPACE::ShiftRight<12>(a) | word(bits_of_one)) -
               real(1);
    }
    static Mask less(Real a, Real b) { return a < b; }
    static Real select(Mask mask, Real a, Real b) { return IfThenElse(mask, a, b); }
    static Real gather(const double* from, Word indices) {
        constexpr hwy::HWY_NAMESPACE::RebindToSigned<Words> ints;
        return GatherIndex(Reals(), from, BitCast(ints, indices));
    }
};
