// Packs: many environments in vector registers, evaluated together.
//
// Pack<n> is a lane type (lane.hpp). Its reals and ints are n values in as many registers as that
// takes, its bools the n bits of an unsigned number. Pack<n, float> has reals of half the width. An
// operator does in a lane what it does to the scalar there, bit for bit.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/lanes/real.hpp>
#include <rddl/lanes/simd.hpp>
#include <rddl/lanes/simd_byte_ints.hpp>
#include <rddl/lanes/simd_floats.hpp>
#include <rddl/lanes/simd_halves.hpp>
#include <rddl/lanes/simd_moves.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#define RDDL_INLINE RDDL_ALWAYS_INLINE constexpr
#define RDDL_INLINE_LAMBDA __attribute__((always_inline))

namespace rddl::inline RDDL_SIMD_LEVEL {

// ------------------------------------------------------------------------------------ bools

template <int n>
struct Mask {
    using Bits = typename simd::BitsOf<n>::type;
    static constexpr auto everywhere = static_cast<Bits>(~std::uint64_t{0} >> (64 - n));
    Bits bits;

    Mask() = default;
    RDDL_INLINE Mask(bool value) : bits(value ? everywhere : Bits{0}) {}
    template <class T>
    requires std::is_arithmetic_v<T> Mask(T)
    = delete;  // numbers are not bools
    static RDDL_INLINE Mask of_bits(std::uint64_t bits) {
        Mask mask;
        mask.bits = static_cast<Bits>(bits);
        return mask;
    }

    RDDL_INLINE bool operator[](int lane) const { return (bits >> lane & 1) != 0; }
    RDDL_INLINE void set(int lane, bool value) {
        const Bits bit = static_cast<Bits>(Bits{1} << lane);
        bits = static_cast<Bits>(value ? bits | bit : bits & ~bit);
    }

    // The right operand of a connective never faults (docs/ir.md), so both are evaluated.
    friend RDDL_INLINE Mask operator&&(Mask a, Mask b) { return of_bits(a.bits & b.bits); }
    friend RDDL_INLINE Mask operator||(Mask a, Mask b) { return of_bits(a.bits | b.bits); }
    friend RDDL_INLINE Mask operator&(Mask a, Mask b) { return a && b; }
    friend RDDL_INLINE Mask operator|(Mask a, Mask b) { return a || b; }
    friend RDDL_INLINE Mask operator!(Mask a) {
        return of_bits(~std::uint64_t{a.bits} & everywhere);
    }
    friend RDDL_INLINE Mask operator==(Mask a, Mask b) { return !(a != b); }
    friend RDDL_INLINE Mask operator!=(Mask a, Mask b) { return of_bits(a.bits ^ b.bits); }
};

RDDL_INLINE bool all(bool a) {
    return a;
}
template <int n>
RDDL_INLINE bool any(Mask<n> a) {
    return a.bits != 0;
}
template <int n>
RDDL_INLINE bool all(Mask<n> a) {
    return any(!a) == false;
}

// Calls body(lane) for each lane where the mask holds.
template <class Body>
constexpr void for_each_lane(bool mask, Body&& body) {
    if (mask) body(0);
}
template <int n, class Body>
constexpr void for_each_lane(Mask<n> mask, Body&& body) {
    for (std::uint64_t rest = mask.bits; rest != 0; rest &= rest - 1) body(__builtin_ctzll(rest));
}

// --------------------------------------------------------------------------------- numbers

// n values of type double, float, int64_t, uint64_t or uint32_t; or of int8_t, with 64 lanes.
template <class T, int n>
struct Lanes {
    using Element = T;
    using Vector = typename simd::VectorsFor<T, n>::type;
    static constexpr int width = n;
    static constexpr bool is_half = n < simd::lanes_of<T>;  // of a register
    static constexpr int part_width = is_half ? n : simd::lanes_of<T>;
    static constexpr int part_count = n / part_width;
    static_assert(n % part_width == 0);

    Vector part[part_count];

    Lanes() = default;
    // Several registers are copied one by one. GCC copies structs in pieces of the size that -mtune
    // prefers, 16 or 32 bytes with many a -march=native, and a load of 64 bytes waits for pieces
    // that have just been stored. So does a table of byte ints, each of which is one register. The
    // bytes of lanes may also be copied, as records are.
    static constexpr bool is_copied_by_parts = part_count > 1 || std::same_as<T, std::int8_t>;
    Lanes(const Lanes&) = default;
    RDDL_INLINE Lanes(const Lanes& other) requires is_copied_by_parts {
        copy_parts(other, std::make_index_sequence<part_count>());
    }
    Lanes& operator=(const Lanes&) = default;
    RDDL_INLINE Lanes& operator=(const Lanes& other) requires is_copied_by_parts {
        copy_parts(other, std::make_index_sequence<part_count>());
        return *this;
    }
    template <class Number>
    requires std::is_arithmetic_v<Number> &&(!std::same_as<Number, bool>)  //
        RDDL_INLINE Lanes(Number everywhere)
        : Lanes(filled(static_cast<T>(everywhere))) {}

    // Makes lanes of the results of `operation` on the operands' registers.
    template <class Operation, class... Operands>
    static RDDL_INLINE Lanes each(Operation operation, const Operands&... operands) {
        return each_part(operation, std::make_index_sequence<part_count>(), operands...);
    }

    static RDDL_INLINE Lanes load(const T* from) { return load_bytes(from); }
    // Loads from addresses that are `distance` bytes apart.
    static RDDL_INLINE Lanes load_apart(const std::byte* from, std::int64_t distance) {
        if (distance == sizeof(T)) return load_bytes(from);
        Lanes result;
        for (int p = 0; p < part_count; ++p)
            result.part[p] = simd::load_apart<Vector>(from + p * part_width * distance, distance);
        return result;
    }
    RDDL_INLINE void store(void* to) const {
        for (int p = 0; p < part_count; ++p)
            __builtin_memcpy(static_cast<char*>(to) + p * sizeof(Vector), &part[p], sizeof(Vector));
    }

    RDDL_INLINE T operator[](int lane) const { return part[lane / part_width][lane % part_width]; }
    RDDL_INLINE void set(int lane, T value) { part[lane / part_width][lane % part_width] = value; }

    // Byte ints are made of other ints, which are that small.
    RDDL_INLINE Lanes(const Lanes<std::int64_t, n>& wide) requires std::same_as<T, std::int8_t> {
        part[0] = simd::narrowed(wide.part);
    }

    friend RDDL_INLINE Lanes operator+(Lanes a, Lanes b) {
        return each([](Vector x, Vector y) RDDL_INLINE_LAMBDA { return x + y; }, a, b);
    }
    friend RDDL_INLINE Lanes operator-(Lanes a, Lanes b) {
        return each([](Vector x, Vector y) RDDL_INLINE_LAMBDA { return x - y; }, a, b);
    }
    friend RDDL_INLINE Lanes operator*(Lanes a, Lanes b) {
        return each([](Vector x, Vector y) RDDL_INLINE_LAMBDA { return x * y; }, a, b);
    }
    friend RDDL_INLINE Lanes operator/(Lanes a, Lanes b) {
        return each([](Vector x, Vector y) RDDL_INLINE_LAMBDA { return x / y; }, a, b);
    }
    friend RDDL_INLINE Lanes operator-(Lanes a) {
        return each([](Vector x) RDDL_INLINE_LAMBDA { return -x; }, a);
    }
    Lanes& operator+=(Lanes other) { return *this = *this + other; }

    friend RDDL_INLINE Lanes operator&(Lanes a, Lanes b) {
        return each([](Vector x, Vector y) RDDL_INLINE_LAMBDA { return x & y; }, a, b);
    }
    friend RDDL_INLINE Lanes operator|(Lanes a, Lanes b) {
        return each([](Vector x, Vector y) RDDL_INLINE_LAMBDA { return x | y; }, a, b);
    }
    friend RDDL_INLINE Lanes operator^(Lanes a, Lanes b) {
        return each([](Vector x, Vector y) RDDL_INLINE_LAMBDA { return x ^ y; }, a, b);
    }
    friend RDDL_INLINE Lanes operator>>(Lanes a, int count) {
        return each([count](Vector x) RDDL_INLINE_LAMBDA { return x >> count; }, a);
    }
    friend RDDL_INLINE Lanes operator<<(Lanes a, int count) {
        return each([count](Vector x) RDDL_INLINE_LAMBDA { return x << count; }, a);
    }

    friend RDDL_INLINE Mask<n> operator<(Lanes a, Lanes b) {
        return mask([](Vector x, Vector y) RDDL_INLINE_LAMBDA { return simd::less(x, y); }, a, b);
    }
    friend RDDL_INLINE Mask<n> operator<=(Lanes a, Lanes b) {
        return mask([](Vector x, Vector y) RDDL_INLINE_LAMBDA { return simd::less_equal(x, y); }, a,
                    b);
    }
    friend RDDL_INLINE Mask<n> operator==(Lanes a, Lanes b) {
        return mask([](Vector x, Vector y) RDDL_INLINE_LAMBDA { return simd::equal(x, y); }, a, b);
    }
    friend RDDL_INLINE Mask<n> operator>(Lanes a, Lanes b) { return b < a; }
    friend RDDL_INLINE Mask<n> operator>=(Lanes a, Lanes b) { return b <= a; }
    friend RDDL_INLINE Mask<n> operator!=(Lanes a, Lanes b) { return !(a == b); }

  private:
    static RDDL_INLINE Lanes load_bytes(const void* from) {
        Lanes result;
        for (int p = 0; p < part_count; ++p)
            __builtin_memcpy(&result.part[p], static_cast<const char*>(from) + p * sizeof(Vector),
                             sizeof(Vector));
        return result;
    }
    static RDDL_INLINE Lanes filled(T value) {
        return each([value]() RDDL_INLINE_LAMBDA { return value - Vector{}; });  // keeps -0.0
    }
    template <class Operation, std::size_t... p, class... Operands>
    static RDDL_INLINE Lanes each_part(Operation operation, std::index_sequence<p...>,
                                       const Operands&... operands) {
        Lanes result;
        ((result.part[p] = one_part<p>(operation, operands...)), ...);
        return result;
    }
    template <std::size_t... p>
    RDDL_INLINE void copy_parts(const Lanes& other, std::index_sequence<p...>) {
        ((part[p] = other.part[p]), ...);
    }
    template <std::size_t p, class Operation, class... Operands>
    static RDDL_INLINE Vector one_part(Operation operation, const Operands&... operands) {
        return operation(operands.part[p]...);
    }
    template <class Compare>
    static RDDL_INLINE Mask<n> mask(Compare compare, const Lanes& a, const Lanes& b) {
        return Mask<n>::of_bits(mask_of_parts<0, part_count>(compare, a, b));
    }
    template <int first, int count, class Compare>
    static RDDL_INLINE std::uint64_t mask_of_parts(Compare compare, const Lanes& a,
                                                   const Lanes& b) {
        if constexpr (count == 1) {
            return compare(a.part[first], b.part[first]);
        } else {
            constexpr int half = count / 2;
            return simd::joined<half * part_width>(
                mask_of_parts<first, half>(compare, a, b),
                mask_of_parts<first + half, half>(compare, a, b));
        }
    }
};

// Part i of several equal ones of all lanes.
template <class Part, class T, int n>
RDDL_INLINE Part part_of(const Lanes<T, n>& all, std::size_t i) {
    Part part;
    if constexpr (Part::is_half && !Lanes<T, n>::is_half)
        part.part[0] = simd::half_of(all.part[i / 2], static_cast<int>(i % 2));
    else
        for (std::size_t p = 0; p < Part::part_count; ++p)
            part.part[p] = all.part[i * Part::part_count + p];
    return part;
}
template <class T, int n, int some>
RDDL_INLINE void set_part(Lanes<T, n>& all, std::size_t i, const Lanes<T, some>& part) {
    constexpr std::size_t count = Lanes<T, some>::part_count;
    for (std::size_t p = 0; p < count; ++p) all.part[i * count + p] = part.part[p];
}

// ----------------------------------------------------------------------------- the lane type

template <int n, class R = double>
struct Pack {
    static constexpr int width = n;
    using Element = R;
    using Bool = Mask<n>;
    using Int = Lanes<std::int64_t, n>;
    using Real = Lanes<R, n>;
    using Count = Lanes<std::int64_t, n>;  // of steps or episodes
    using Word = Lanes<std::uint64_t, n>;
};

// The same with ints of a byte, for problems whose ints are that small. Without
// RDDL_SIMD_BYTE_INTS there are none.
template <class R = double>
struct ByteIntPack : Pack<64, R> {
    using Int = Lanes<std::int8_t, 64>;
};
template <class L>
inline constexpr bool has_byte_ints = std::is_same_v<typename L::Int, Lanes<std::int8_t, 64>>;

}  // namespace rddl::inline RDDL_SIMD_LEVEL
