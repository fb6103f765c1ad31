// The operators of ops.hpp on packs. Where one operand is the same in all lanes it may be a plain
// number. Functions without a form for registers are called lane by lane.
//
// Over 400 lines: an operator after the other, in the order of ops.hpp.
#pragma once

#include <rddl/lanes/pack.hpp>
#include <rddl/lanes/real.hpp>
#include <rddl/lanes/simd_moves.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/ops.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

namespace rddl {

// ------------------------------------------------------------------------------ their types

namespace detail {

template <class T>
inline constexpr int pack_width = 0;
template <int n>
inline constexpr int pack_width<Mask<n>> = n;
template <class T, int n>
inline constexpr int pack_width<Lanes<T, n>> = n;

// The pack type for values of a scalar or pack type.
template <class T, int n>
struct Widened;
template <int n>
struct Widened<bool, n> {
    using type = Mask<n>;
};
template <class T, int n>
requires std::is_arithmetic_v<T>
struct Widened<T, n> {
    using type = Lanes<
        std::conditional_t<std::is_floating_point_v<T>, T,
                           std::conditional_t<std::is_unsigned_v<T>, std::uint64_t, std::int64_t>>,
        n>;
};
template <int n>
struct Widened<Mask<n>, n> {
    using type = Mask<n>;
};
template <class T, int n>
struct Widened<Lanes<T, n>, n> {
    using type = Lanes<T, n>;
};

template <class T>
inline constexpr bool are_byte_ints = std::is_same_v<T, Lanes<std::int8_t, 64>>;

template <class A, class B>
inline constexpr int common_width = pack_width<A> > pack_width<B> ? pack_width<A> : pack_width<B>;

}  // namespace detail

// At least one operand is a pack.
template <class... Operands>
concept SomePack = ((detail::pack_width<Operands> > 0) || ...);

template <class T, int n>
using LanesOf = typename detail::Widened<T, n>::type;

// The pack type of values that have the type of A or of B. What meets byte ints is as small.
template <class A, class B, int n = detail::common_width<A, B>>
using CommonLanes = std::conditional_t<detail::are_byte_ints<B>, B, LanesOf<A, n>>;
template <class A, class B>
using CommonInts =
    std::conditional_t<detail::are_byte_ints<A> || detail::are_byte_ints<B>, Lanes<std::int8_t, 64>,
                       Lanes<std::int64_t, detail::common_width<A, B>>>;

// Calls a function of scalars for each lane.
template <class A, class Function>
requires SomePack<A>
[[gnu::noinline]] auto map_lanes(const A& a, Function function) {
    constexpr int n = detail::pack_width<A>;
    LanesOf<decltype(function(a[0])), n> results{};
    for (int lane = 0; lane < n; ++lane) results.set(lane, function(a[lane]));
    return results;
}
template <class A, class Function>
requires SomePack<A>
[[gnu::noinline]] auto map_lanes(const A& a, const A& b, Function function) {
    constexpr int n = detail::pack_width<A>;
    LanesOf<decltype(function(a[0], b[0])), n> results{};
    for (int lane = 0; lane < n; ++lane) results.set(lane, function(a[lane], b[lane]));
    return results;
}
// In these lanes alone; the others are given.
template <int n, class Function>
[[gnu::noinline, gnu::cold]] Lanes<double, n> replace_lanes(Mask<n> replaced,
                                                            const Lanes<double, n>& a,
                                                            Lanes<double, n> others,
                                                            Function function) {
    for_each_lane(replaced, [&](int lane) { others.set(lane, function(a[lane])); });
    return others;
}

// ---------------------------------------------------------------------------------- choices

namespace detail {

template <int n>
RDDL_INLINE Mask<n> choose(Mask<n> condition, Mask<n> a, Mask<n> b) {
    return (condition && a) || (!condition && b);
}
// The bits of each register.
template <int part_count>
struct MaskParts {
    simd::MaskBits part[part_count];
};
template <int n>
RDDL_INLINE Lanes<std::int8_t, n> choose(Mask<n> condition, const Lanes<std::int8_t, n>& a,
                                         const Lanes<std::int8_t, n>& b) {
    return Lanes<std::int8_t, n>::each(
        [condition](auto x, auto y)
            RDDL_INLINE_LAMBDA { return simd::blend(condition.bits, x, y); },
        a, b);
}
template <class T, int n, std::size_t... p>
RDDL_INLINE auto parts_of(Mask<n> mask, std::index_sequence<p...>) {
    constexpr int width = Lanes<T, n>::part_width;
    constexpr std::uint64_t all = simd::all_lanes_of<T>;
    return MaskParts<sizeof...(p)>{
        static_cast<simd::MaskBits>(std::uint64_t{mask.bits} >> (p * width) & all)...};
}
template <class T, int n>
RDDL_INLINE Lanes<T, n> choose(Mask<n> condition, const Lanes<T, n>& a, const Lanes<T, n>& b) {
    return Lanes<T, n>::each(
        [](auto bits, auto x, auto y) RDDL_INLINE_LAMBDA { return simd::blend(bits, x, y); },
        parts_of<T>(condition, std::make_index_sequence<Lanes<T, n>::part_count>()), a, b);
}

}  // namespace detail

template <int n, class A, class B>
requires std::is_same_v<CommonLanes<A, B, n>, CommonLanes<B, A, n>> RDDL_INLINE auto select(
    Mask<n> condition, const A& a, const B& b) {
    using Result = CommonLanes<A, B, n>;
    return detail::choose(condition, Result(a), Result(b));
}
template <class A, class B>
requires SomePack<A, B> RDDL_INLINE auto select(bool condition, const A& a, const B& b) {
    using Result = LanesOf<A, detail::common_width<A, B>>;
    return condition ? Result(a) : Result(b);
}

// Evaluates each branch that some lane takes; the others cannot fault meanwhile.
template <class L, class Condition, class Then, class Else>
requires(L::width > 1) constexpr auto branch(Context<L>& context, Condition condition,
                                             Then&& then_value, Else&& else_value) {
    constexpr int n = L::width;
    using Result = LanesOf<decltype(then_value()), n>;
    static_assert(std::is_same_v<Result, LanesOf<decltype(else_value()), n>>);
    if constexpr (std::is_same_v<Condition, bool>)  // the same in all lanes
        return condition ? Result(then_value()) : Result(else_value());
    const Mask<n> chosen = condition;
    const Mask<n> active = context.active;
    const auto within = [&](Mask<n> lanes, auto& value) -> Result {
        if (!any(lanes)) return Result{};
        context.active = lanes;
        return value();
    };
    const Result a = within(active && chosen, then_value);
    const Result b = within(active && !chosen, else_value);
    context.active = active;
    return select(chosen, a, b);
}

template <int n, class Then, class Else>
constexpr auto branch(Mask<n> condition, Then&& then_value, Else&& else_value) {
    return select(condition, then_value(), else_value());
}

// ------------------------------------------------------------------------------ conversions

namespace detail {

// Register by register: what is cast as a whole goes through memory.
template <class To, class From, int n>
RDDL_INLINE Lanes<To, n> same_bits(const Lanes<From, n>& a) {
    return Lanes<To, n>::each(
        [](auto x) RDDL_INLINE_LAMBDA { return std::bit_cast<typename Lanes<To, n>::Vector>(x); },
        a);
}

// Lanes of 64 bits, a register of them for each half register of floats.
template <class To, int n, class Operation>
RDDL_INLINE Lanes<To, n> of_halves(const Lanes<float, n>& a, Operation operation) {
    Lanes<To, n> result;
    if constexpr (Lanes<float, n>::is_half)
        result.part[0] = operation(a.part[0]);
    else
        for (int p = 0; p < result.part_count; ++p)
            result.part[p] = operation(simd::half_of(a.part[p / 2], p % 2));
    return result;
}
template <class From, int n>
RDDL_INLINE Lanes<float, n> float_lanes(const Lanes<From, n>& a) {
    Lanes<float, n> result;
    if constexpr (Lanes<float, n>::is_half)
        result.part[0] = simd::to_floats(a.part[0]);
    else
        for (int p = 0; p < result.part_count; ++p)
            result.part[p] =
                simd::joined(simd::to_floats(a.part[2 * p]), simd::to_floats(a.part[2 * p + 1]));
    return result;
}

}  // namespace detail

template <int n>
RDDL_INLINE Lanes<double, n> to_double(const Lanes<float, n>& a) {
    return detail::of_halves<double>(a,
                                     [](auto x) RDDL_INLINE_LAMBDA { return simd::to_reals(x); });
}
template <int n>
RDDL_INLINE Lanes<float, n> to_float(const Lanes<double, n>& a) {
    return detail::float_lanes(a);
}
template <int n>
RDDL_INLINE Lanes<float, n> to_float(const Lanes<std::int64_t, n>& a) {
    return detail::float_lanes(a);
}
template <int n>
RDDL_INLINE Lanes<float, n> to_float(Mask<n> a) {
    return select(a, 1.0f, 0.0f);
}

template <int n>
RDDL_INLINE Lanes<std::int64_t, n> to_int(Mask<n> a) {
    return select(a, std::int64_t{1}, std::int64_t{0});
}
template <int n>
RDDL_INLINE Lanes<double, n> to_real(Mask<n> a) {
    return select(a, 1.0, 0.0);
}
template <int n>
RDDL_INLINE Lanes<double, n> to_real(const Lanes<std::int64_t, n>& a) {
    return Lanes<double, n>::each([](auto x) RDDL_INLINE_LAMBDA { return simd::to_reals(x); }, a);
}
// The ints of byte ints, as 64 bits, which pass through memory: loads spread bytes.
template <int n>
RDDL_INLINE Lanes<std::int64_t, n> widened(const Lanes<std::int8_t, n>& a) {
    std::int8_t bytes[n];
    a.store(bytes);
    Lanes<std::int64_t, n> ints;
    for (int p = 0; p < ints.part_count; ++p)
        ints.part[p] = simd::widened(bytes + p * ints.part_width);
    return ints;
}
template <int n>
RDDL_INLINE Lanes<double, n> to_real(const Lanes<std::int8_t, n>& a) {
    return to_real(widened(a));
}
template <int n>
RDDL_INLINE Lanes<float, n> to_float(const Lanes<std::int8_t, n>& a) {
    std::int8_t bytes[n];
    a.store(bytes);
    Lanes<float, n> reals;
    for (int p = 0; p < reals.part_count; ++p)
        reals.part[p] = simd::floats_of(bytes + p * reals.part_width);
    return reals;
}
// As ints of this type.
template <class Int, int n>
RDDL_INLINE auto to_int(Mask<n> a) {
    using Ints = LanesOf<Int, n>;
    return select(a, Ints{1}, Ints{0});
}
template <int n>
RDDL_INLINE Lanes<std::int64_t, n> truncate_to_int(const Lanes<double, n>& a) {
    return Lanes<std::int64_t, n>::each([](auto x) RDDL_INLINE_LAMBDA { return simd::truncate(x); },
                                        a);
}
template <int n>
RDDL_INLINE Lanes<std::int64_t, n> truncate_to_int(const Lanes<float, n>& a) {
    return detail::of_halves<std::int64_t>(
        a, [](auto x) RDDL_INLINE_LAMBDA { return simd::truncate(x); });
}

constexpr std::uint64_t words_of(std::int64_t a) {
    return static_cast<std::uint64_t>(a);
}
template <int n>
RDDL_INLINE Lanes<double, n> real_of_bits(const Lanes<std::uint64_t, n>& a) {
    return detail::same_bits<double>(a);
}
template <int n>
RDDL_INLINE Lanes<std::uint64_t, n> bits_of(const Lanes<double, n>& a) {
    return detail::same_bits<std::uint64_t>(a);
}
template <int n>
RDDL_INLINE Lanes<float, n> real_of_bits(const Lanes<std::uint32_t, n>& a) {
    return detail::same_bits<float>(a);
}
template <int n>
RDDL_INLINE Lanes<std::uint32_t, n> bits_of(const Lanes<float, n>& a) {
    return detail::same_bits<std::uint32_t>(a);
}
template <int n>
RDDL_INLINE Lanes<std::uint64_t, n> words_of(const Lanes<std::int64_t, n>& a) {
    return detail::same_bits<std::uint64_t>(a);
}
template <int n>
RDDL_INLINE Lanes<std::int64_t, n> ints_of(const Lanes<std::uint64_t, n>& a) {
    return detail::same_bits<std::int64_t>(a);
}

// The first in lanes where the last bit is 0, else the second.
template <class Bits, class R, int n>
RDDL_INLINE Lanes<R, n> first_if_even(const Lanes<Bits, n>& bits, const Lanes<R, n>& first,
                                      const Lanes<R, n>& second) {
    return Lanes<R, n>::each([](auto b, auto x, auto y)
                                 RDDL_INLINE_LAMBDA { return simd::first_if_even(b, x, y); },
                             bits, first, second);
}

// The lanes of a and b in turns.
template <class T, int n>
RDDL_INLINE Lanes<T, 2 * n> interleaved(const Lanes<T, n>& a, const Lanes<T, n>& b) {
    Lanes<T, 2 * n> result;
    for (int p = 0; p < a.part_count; ++p) {
        result.part[2 * p] = simd::interleave_half(a.part[p], b.part[p], 0);
        result.part[2 * p + 1] = simd::interleave_half(a.part[p], b.part[p], 1);
    }
    return result;
}

template <int n>
RDDL_INLINE Lanes<std::uint64_t, n> multiply_low_halves(const Lanes<std::uint64_t, n>& a,
                                                        const Lanes<std::uint64_t, n>& b) {
    return Lanes<std::uint64_t, n>::each(
        [](auto x, auto y) RDDL_INLINE_LAMBDA { return simd::multiply_low_halves(x, y); }, a, b);
}

template <int n>
RDDL_INLINE Lanes<std::uint64_t, n> upper_halves(const Lanes<std::uint64_t, n>& a) {
    return Lanes<std::uint64_t, n>::each(
        [](auto x) RDDL_INLINE_LAMBDA { return simd::upper_halves(x); }, a);
}
template <int n>
RDDL_INLINE Lanes<std::uint32_t, n> lower_halves(const Lanes<std::uint64_t, n>& a) {
    Lanes<std::uint32_t, n> result;
    if constexpr (Lanes<std::uint32_t, n>::is_half)
        result.part[0] = simd::lower_halves(a.part[0]);
    else
        for (int p = 0; p < result.part_count; ++p)
            result.part[p] = simd::lower_halves(a.part[2 * p], a.part[2 * p + 1]);
    return result;
}
constexpr std::uint64_t join_lower_halves(std::uint64_t low, std::uint64_t high) {
    return (low & 0xFFFFFFFF) | high << 32;
}
template <int n>
RDDL_INLINE Lanes<std::uint64_t, n> join_lower_halves(const Lanes<std::uint64_t, n>& low,
                                                      const Lanes<std::uint64_t, n>& high) {
    return Lanes<std::uint64_t, n>::each(
        [](auto x, auto y) RDDL_INLINE_LAMBDA { return simd::join_lower_halves(x, y); }, low, high);
}

// --------------------------------------------------------------------------- int arithmetic

namespace detail {

template <class Int, class Operation, class A, class B>
RDDL_INLINE Int wrapped(Operation operation, const A& a, const B& b) {
    if constexpr (are_byte_ints<Int>)
        return Int::each(
            [operation](auto x, auto y) RDDL_INLINE_LAMBDA {
                return simd::reinterpret<simd::ByteInts>(operation(
                    simd::reinterpret<simd::ByteWords>(x), simd::reinterpret<simd::ByteWords>(y)));
            },
            Int(a), Int(b));
    else
        return ints_of(operation(words_of(Int(a)), words_of(Int(b))));
}

}  // namespace detail

template <class A, class B>
requires SomePack<A, B> RDDL_INLINE auto wrap_add(const A& a, const B& b) {
    return detail::wrapped<CommonInts<A, B>>(
        [](auto x, auto y) RDDL_INLINE_LAMBDA { return x + y; }, a, b);
}
template <class A, class B>
requires SomePack<A, B> RDDL_INLINE auto wrap_sub(const A& a, const B& b) {
    return detail::wrapped<CommonInts<A, B>>(
        [](auto x, auto y) RDDL_INLINE_LAMBDA { return x - y; }, a, b);
}
template <class A, class B>
requires SomePack<A, B> RDDL_INLINE auto wrap_mul(const A& a, const B& b) {
    using Int = Lanes<std::int64_t, detail::common_width<A, B>>;
    return ints_of(words_of(Int(a)) * words_of(Int(b)));
}
// A bool as a factor is a choice, which takes one instruction where a product takes three.
template <int n, class B>
RDDL_INLINE Lanes<std::int64_t, n> wrap_mul(Mask<n> is_one, const B& b) {
    return select(is_one, b, std::int64_t{0});
}
template <int n, class A>
RDDL_INLINE Lanes<std::int64_t, n> wrap_mul(const A& a, Mask<n> is_one) {
    return select(is_one, a, std::int64_t{0});
}
// A bool that all lanes share, as that of an environment beside the ints of its objects.
template <int n>
RDDL_INLINE Lanes<std::int64_t, n> wrap_mul(bool is_one, const Lanes<std::int64_t, n>& b) {
    return wrap_mul(Mask<n>(is_one), b);
}
template <int n>
RDDL_INLINE Lanes<std::int64_t, n> wrap_mul(const Lanes<std::int64_t, n>& a, bool is_one) {
    return wrap_mul(a, Mask<n>(is_one));
}
template <class T, int n>
RDDL_INLINE Lanes<T, n> wrap_neg(const Lanes<T, n>& a) {
    return wrap_sub(std::int64_t{0}, a);
}

template <class A, class B>
requires SomePack<A, B>
auto floor_div(const A& a, const B& b) {
    using Int = Lanes<std::int64_t, detail::common_width<A, B>>;
    return map_lanes(Int(a), Int(b),
                     [](std::int64_t x, std::int64_t y) { return floor_div(x, y); });
}
template <class A, class B>
requires SomePack<A, B> RDDL_INLINE auto floor_mod(const A& a, const B& b) {
    using Result = LanesOf<A, detail::common_width<A, B>>;
    using Element = typename Result::Element;
    const Result x(a), y(b);
    if constexpr (std::is_floating_point_v<Element>)
        return floor_mod(x, y);
    else
        return map_lanes(
            x, y, [](Element dividend, Element divisor) { return floor_mod(dividend, divisor); });
}

// ---------------------------------------------------------------------- ints and reals alike

template <class T, int n>
RDDL_INLINE Mask<n> is_nan(const Lanes<T, n>& a) {
    return a != a;
}

template <int n>
RDDL_INLINE Lanes<double, n> absolute(const Lanes<double, n>& a) {
    return real_of_bits(bits_of(a) & Lanes<std::uint64_t, n>{~(std::uint64_t{1} << 63)});
}
template <int n>
RDDL_INLINE Lanes<float, n> absolute(const Lanes<float, n>& a) {
    return real_of_bits(bits_of(a) & Lanes<std::uint32_t, n>{~(std::uint32_t{1} << 31)});
}
template <int n>
RDDL_INLINE Lanes<std::int64_t, n> absolute(const Lanes<std::int64_t, n>& a) {
    return select(a < std::int64_t{0}, wrap_neg(a), a);
}

template <class T, int n>
RDDL_INLINE Lanes<std::int64_t, n> sign(const Lanes<T, n>& a) {
    const Lanes<T, n> zero{T{0}};
    const auto signs = wrap_sub(to_int(a > zero), to_int(a < zero));
    return select(is_nan(a), std::numeric_limits<std::int64_t>::min(), signs);
}

// nan wins, and of equal numbers the first. Register by register, since masks over all lanes cost
// more than the comparisons; with a constant, as often, that takes one instruction.
template <std::floating_point R>
RDDL_INLINE bool is_plus_zero(R a) {
    return a == 0 && __builtin_copysign(R{1}, a) > 0;
}
// All other numbers and nan stay what they are.
template <std::floating_point R, int n>
RDDL_INLINE Lanes<R, n> without_minus_zero(const Lanes<R, n>& a) {
    return a + Lanes<R, n>{R{0}};
}
template <class A, class B>
requires SomePack<A, B> RDDL_INLINE auto minimum(const A& a, const B& b) {
    using Result = CommonLanes<A, B>;
    const Result x(a), y(b);
    if constexpr (std::is_floating_point_v<A>) {
        const auto first_unless_beyond = [](auto p, auto q) RDDL_INLINE_LAMBDA {
            return p < q ? p : q;
        };
        if (!is_zero_or_nan(a)) return Result::each(first_unless_beyond, x, y);
        if (is_plus_zero(a)) return Result::each(first_unless_beyond, x, without_minus_zero(y));
    }
    if constexpr (std::is_floating_point_v<B>)
        if (!is_nan(b))
            return Result::each([](auto p, auto q) RDDL_INLINE_LAMBDA { return q < p ? q : p; }, x,
                                y);
    return Result::each(
        [](auto p, auto q) RDDL_INLINE_LAMBDA { return ((q < p) | (q != q)) ? q : p; }, x, y);
}
template <class A, class B>
requires SomePack<A, B> RDDL_INLINE auto maximum(const A& a, const B& b) {
    using Result = CommonLanes<A, B>;
    const Result x(a), y(b);
    if constexpr (std::is_floating_point_v<A>) {
        const auto first_unless_beyond = [](auto p, auto q) RDDL_INLINE_LAMBDA {
            return p > q ? p : q;
        };
        if (!is_zero_or_nan(a)) return Result::each(first_unless_beyond, x, y);
        if (is_plus_zero(a)) return Result::each(first_unless_beyond, x, without_minus_zero(y));
    }
    if constexpr (std::is_floating_point_v<B>)
        if (!is_nan(b))
            return Result::each([](auto p, auto q) RDDL_INLINE_LAMBDA { return q > p ? q : p; }, x,
                                y);
    return Result::each(
        [](auto p, auto q) RDDL_INLINE_LAMBDA { return ((q > p) | (q != q)) ? q : p; }, x, y);
}

// ----------------------------------------------------------------------------- real functions

template <std::floating_point R, int n>
RDDL_INLINE Lanes<R, n> sqrt(const Lanes<R, n>& a) {
    return Lanes<R, n>::each([](auto x) RDDL_INLINE_LAMBDA { return simd::square_root(x); }, a);
}

// Functions of two operands, one of which is the same in all lanes.
#define RDDL_BROADCAST(function)                                                 \
    template <class A, class B>                                                  \
    requires(SomePack<A> != SomePack<B>) auto function(const A& a, const B& b) { \
        using Real = LanesOf<A, detail::common_width<A, B>>;                     \
        return function(Real(a), Real(b));                                       \
    }
RDDL_BROADCAST(log)
RDDL_BROADCAST(hypot)
RDDL_BROADCAST(atan2)
#undef RDDL_BROADCAST

// See the power of scalars: by far the most frequent exponents are a constant 2 and 0.5.
template <std::floating_point R, int n>
RDDL_INLINE Lanes<R, n> power(const Lanes<R, n>& base, std::type_identity_t<R> exponent) {
    if (exponent == R{2}) return base * base;
    if constexpr (std::is_same_v<R, double>)
        if (exponent == 0.5) return detail::root_power(base);
    return power(base, Lanes<R, n>(exponent));
}
template <std::floating_point R, int n>
Lanes<R, n> power(std::type_identity_t<R> base, const Lanes<R, n>& exponent) {
    return power(Lanes<R, n>(base), exponent);
}

template <std::floating_point R, int n>
RDDL_INLINE Lanes<std::int64_t, n> round(const Lanes<R, n>& a) {
    return truncate_to_int(
        Lanes<R, n>::each([](auto x) RDDL_INLINE_LAMBDA { return simd::nearest(x); }, a));
}
template <std::floating_point R, int n>
RDDL_INLINE Lanes<std::int64_t, n> floor(const Lanes<R, n>& a) {
    return truncate_to_int(
        Lanes<R, n>::each([](auto x) RDDL_INLINE_LAMBDA { return simd::floor(x); }, a));
}
template <std::floating_point R, int n>
RDDL_INLINE Lanes<std::int64_t, n> ceil(const Lanes<R, n>& a) {
    return truncate_to_int(
        Lanes<R, n>::each([](auto x) RDDL_INLINE_LAMBDA { return simd::ceil(x); }, a));
}

namespace detail {

// See that of one real; ints would take twice the registers.
template <int n>
RDDL_INLINE Lanes<float, n> whole_as_real(const Lanes<float, n>& a) {
    return select(absolute(a) < 0x1p63f, a + 0.0f, -0x1p63f);
}

}  // namespace detail

template <int n>
RDDL_INLINE Lanes<double, n> round_as_real(const Lanes<double, n>& a) {
    return to_real(round(a));
}
template <int n>
RDDL_INLINE Lanes<float, n> round_as_real(const Lanes<float, n>& a) {
    return detail::whole_as_real(
        Lanes<float, n>::each([](auto x) RDDL_INLINE_LAMBDA { return simd::nearest(x); }, a));
}
template <int n>
RDDL_INLINE Lanes<double, n> floor_as_real(const Lanes<double, n>& a) {
    return to_real(floor(a));
}
template <int n>
RDDL_INLINE Lanes<float, n> floor_as_real(const Lanes<float, n>& a) {
    return detail::whole_as_real(
        Lanes<float, n>::each([](auto x) RDDL_INLINE_LAMBDA { return simd::floor(x); }, a));
}
template <int n>
RDDL_INLINE Lanes<double, n> ceil_as_real(const Lanes<double, n>& a) {
    return to_real(ceil(a));
}
template <int n>
RDDL_INLINE Lanes<float, n> ceil_as_real(const Lanes<float, n>& a) {
    return detail::whole_as_real(
        Lanes<float, n>::each([](auto x) RDDL_INLINE_LAMBDA { return simd::ceil(x); }, a));
}

template <int n, class R>
Lanes<std::int64_t, n> power(Context<Pack<n, R>>& context, Place place,
                             std::type_identity_t<const Lanes<std::int64_t, n>&> base,
                             std::type_identity_t<const Lanes<std::int64_t, n>&> exponent) {
    const Mask<n> valid = context.require(exponent >= std::int64_t{0}, FaultKind::NegativeExponent,
                                          place, to_real(exponent));
    const auto powers =
        map_lanes(base, exponent, [](std::int64_t x, std::int64_t y) { return wrap_power(x, y); });
    return select(valid, powers, std::int64_t{0});
}

template <int n, class R>
Lanes<R, n> ln_gamma(Context<Pack<n, R>>& context, Place place,
                     std::type_identity_t<const Lanes<R, n>&> a) {
    const Mask<n> valid = context.require(a > R{0}, FaultKind::GammaArgument, place, a);
    return select(valid, map_lanes(a, [](R x) { return static_cast<R>(ln_absolute_gamma(x)); }),
                  R{0});
}
template <int n, class R>
Lanes<R, n> gamma(Context<Pack<n, R>>& context, Place place,
                  std::type_identity_t<const Lanes<R, n>&> a) {
    const Mask<n> valid = context.require(a > R{0}, FaultKind::GammaArgument, place, a);
    return select(valid, map_lanes(a, [](R x) { return static_cast<R>(gamma_of(x)); }), R{0});
}

// --------------------------------------------------------------------------------- indexing

namespace detail {

// The innermost elements of nested arrays, which lie one after the other.
template <class T>
struct Nested {
    using Element = T;
    static constexpr std::int64_t count = 1;
};
template <class T, std::size_t n>
struct Nested<std::array<T, n>> {
    using Element = typename Nested<T>::Element;
    static constexpr std::int64_t count = static_cast<std::int64_t>(n) * Nested<T>::count;
};
template <class Array, class Int, class First, class... Rest>
RDDL_INLINE Int place_in(const First& first, const Rest&... rest) {
    using Row = typename Array::value_type;
    const Int begin = Int(first) * Int(Nested<Row>::count);
    if constexpr (sizeof...(Rest) == 0)
        return begin;
    else
        return begin + place_in<Row, Int>(rest...);
}

// The lanes whose lowest bits are 1.
template <int n>
RDDL_INLINE Mask<n> lowest_bits(const Lanes<std::int64_t, n>& a) {
    return (a & Lanes<std::int64_t, n>(1)) != Lanes<std::int64_t, n>(0);
}

// The bits from these places on.
template <int n>
RDDL_INLINE Lanes<std::int64_t, n> shifted(std::uint64_t bits,
                                           const Lanes<std::int64_t, n>& places) {
    return Lanes<std::int64_t, n>::each(
        [](auto all, auto place)
            RDDL_INLINE_LAMBDA { return (decltype(place))(all >> (decltype(all))place); },
        Lanes<std::uint64_t, n>(bits), places);
}

// The elements that each lane chooses from a table of `count`: its own where the elements are
// packs.
template <std::int64_t count, int n>
Mask<n> gather(const bool* elements, const Lanes<std::int64_t, n>& indices) {
    if constexpr (count <= 64) {
        const std::uint64_t bits = simd::bits_of_bytes(elements, count);
        return lowest_bits(shifted(bits, indices));
    } else {
        return lowest_bits(Lanes<std::int64_t, n>::each(
            [elements](auto place) RDDL_INLINE_LAMBDA {
                return (decltype(place))simd::gather_bytes<count>(elements, place);
            },
            indices));
    }
}
// The same from the first column of a table of few rows of bools, `distance` bools apart.
inline constexpr std::int64_t most_rows_of_column = 16;
template <std::int64_t rows, std::int64_t distance, int n>
RDDL_INLINE Mask<n> gather_from_column(const bool* elements,
                                       const Lanes<std::int64_t, n>& indices) {
    std::uint64_t bits = 0;
    for (std::int64_t row = 0; row < rows; ++row)
        bits |= std::uint64_t{elements[row * distance]} << row;
    return lowest_bits(shifted(bits, indices));
}
template <std::int64_t count, int n>
RDDL_INLINE auto gather(const std::int64_t* elements, const Lanes<std::int64_t, n>& indices) {
    const auto* const reals = reinterpret_cast<const double*>(elements);
    return Lanes<std::int64_t, n>::each(
        [reals](auto x) RDDL_INLINE_LAMBDA {
            return simd::reinterpret<decltype(x)>(simd::look_up<count>(reals, x));
        },
        indices);
}
template <std::int64_t count, int n>
RDDL_INLINE auto gather(const double* elements, const Lanes<std::int64_t, n>& indices) {
    return Lanes<double, n>::each(
        [elements](auto x) RDDL_INLINE_LAMBDA { return simd::look_up<count>(elements, x); },
        indices);
}
template <std::int64_t count, int n>
auto gather(const float* elements, const Lanes<std::int64_t, n>& indices) {
    Lanes<float, n> result;
    if constexpr (Lanes<float, n>::is_half)
        result.part[0] = simd::look_up<count>(elements, indices.part[0]);
    else
        for (int p = 0; p < result.part_count; ++p)
            result.part[p] =
                simd::look_up<count>(elements, indices.part[2 * p], indices.part[2 * p + 1]);
    return result;
}
template <std::int64_t count, class T, int n>
auto gather(const Lanes<T, n>* elements, const Lanes<std::int64_t, n>& indices) {
    Lanes<std::int64_t, n> places;
    for (int p = 0; p < places.part_count; ++p) {
        places.part[p] = indices.part[p] * n;
        for (int i = 0; i < simd::lanes; ++i) places.part[p][i] += p * simd::lanes + i;
    }
    const T* const values = reinterpret_cast<const T*>(elements);
    if constexpr (std::is_same_v<T, float>)
        return gather<count * n>(values, places);
    else
        return Lanes<T, n>::each(
            [values](auto part) RDDL_INLINE_LAMBDA { return simd::gather(values, part); }, places);
}
template <std::int64_t count, int n>
Mask<n> gather(const Mask<n>* elements, const Lanes<std::int64_t, n>& indices) {
    const auto* const masks = reinterpret_cast<const typename Mask<n>::Bits*>(elements);
    Lanes<std::int64_t, n> bits;
    for (int p = 0; p < bits.part_count; ++p) {
        simd::Words lane{};
        for (int i = 0; i < simd::lanes; ++i)
            lane[i] = static_cast<std::uint64_t>(p * simd::lanes + i);
        const simd::Words words = simd::look_up_lowest<count>(masks, indices.part[p]);
        bits.part[p] = (simd::Ints)(words >> lane);
    }
    return lowest_bits(bits);
}

// A register holds a table of so few bools or ints as bytes, which byte ints permute.
template <class T>
inline constexpr bool may_be_byte = std::is_same_v<T, bool> || std::is_same_v<T, std::int64_t>;
template <std::int64_t count, class T, int n>
RDDL_INLINE auto look_up_bytes(const T* elements, const Lanes<std::int8_t, n>& indices) {
    const auto found = Lanes<std::int8_t, n>::each(
        [elements](auto places)
            RDDL_INLINE_LAMBDA { return simd::look_up_bytes<int{count}>(elements, places); },
        indices);
    if constexpr (std::is_same_v<T, bool>)
        return found != Lanes<std::int8_t, n>(0);
    else
        return found;
}
template <class T>
RDDL_INLINE const T& wide_index(const T& index) {
    return index;
}
template <int n>
RDDL_INLINE Lanes<std::int64_t, n> wide_index(const Lanes<std::int8_t, n>& index) {
    return widened(index);
}
// Ints of the table are as small as the indices.
template <class T>
RDDL_INLINE const T& element_for_bytes(const T& element) {
    return element;
}
template <int n>
RDDL_INLINE Lanes<std::int8_t, n> element_for_bytes(const Lanes<std::int64_t, n>& element) {
    return Lanes<std::int8_t, n>(element);
}

// Only the first index differs between the lanes, of a table of bools with more elements than a
// word has bits, but with few rows.
template <class Array, class... Rest>
inline constexpr bool is_read_by_column =
    std::is_same_v<typename Nested<Array>::Element, bool>&& Nested<Array>::count > 64 &&
    std::tuple_size_v<Array> <= most_rows_of_column && sizeof...(Rest) > 0 &&
    (std::is_integral_v<Rest> && ...);

}  // namespace detail

// An element of a nested std::array; at least one index differs between the lanes.
template <class Array, class First, class... Rest>
requires SomePack<First, Rest...> RDDL_INLINE auto at(const Array& array, const First& first,
                                                      const Rest&... rest) {
    if constexpr (std::is_integral_v<First>) {
        return at(array[static_cast<std::size_t>(first)], rest...);
    } else {
        constexpr int n = std::max({detail::pack_width<First>, detail::pack_width<Rest>...});
        using Nested = detail::Nested<Array>;
        const auto* const elements = reinterpret_cast<const typename Nested::Element*>(&array);
        if constexpr (detail::are_byte_ints<First> && sizeof...(Rest) == 0 && Nested::count <= 64 &&
                      detail::may_be_byte<typename Nested::Element>) {
            return detail::look_up_bytes<Nested::count>(elements, first);
        } else if constexpr (detail::are_byte_ints<First> || (detail::are_byte_ints<Rest> || ...)) {
            return detail::element_for_bytes(
                at(array, detail::wide_index(first), detail::wide_index(rest)...));
        } else if constexpr (detail::is_read_by_column<Array, Rest...>) {
            using Row = typename Array::value_type;
            return detail::gather_from_column<std::tuple_size_v<Array>, detail::Nested<Row>::count>(
                elements + detail::place_in<Row, std::int64_t>(rest...), first);
        } else {
            const auto place = detail::place_in<Array, Lanes<std::int64_t, n>>(first, rest...);
            return detail::gather<Nested::count>(elements, place);
        }
    }
}

// An index that is in range in the lanes that count: some index that is in range in all of them.
template <class L, class T>
RDDL_INLINE const T& in_range(const Context<L>&, const T& index) {
    return index;
}

// ------------------------------------------------------------------------ some of the lanes

// The lanes where the mask holds, 8 at most, one after the other; `others` in the rest of the 8.
template <int n>
RDDL_INLINE Lanes<double, 8> compress(Mask<n> mask, const Lanes<double, n>& a, double others) {
    double selected[8];
    simd::compress(mask.bits, a.part, others, selected);
    return Lanes<double, 8>::load(selected);
}
// Expands back to where the mask holds; the other lanes of `target` stay.
template <int n>
RDDL_INLINE void expand(Mask<n> mask, const Lanes<double, 8>& a, Lanes<double, n>& target) {
    double selected[8];
    a.store(selected);
    simd::expand(mask.bits, selected, target.part);
}

}  // namespace rddl
