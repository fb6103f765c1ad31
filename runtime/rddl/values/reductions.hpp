// Aggregations over the objects 0 .. n-1 of one variable, or the entries begin .. end-1 of a table;
// several variables are nested calls.
//
// The body is called once an object, in order, never short-circuited, so that the result of a
// floating sum is fixed and a fault in any element is found. The first template parameter is the
// type of the result. minimum_over, maximum_over, arg_min and arg_max need n > 0.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/values/ops.hpp>
#include <rddl/values/pack_ops.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace rddl {

// The range of an aggregation: [begin, end), or all of n objects.
struct IndexRange {
    constexpr IndexRange(Index n) : begin(0), end(n) {}
    constexpr IndexRange(Index first, Index last) : begin(first), end(last) {}

    Index begin, end;
};

// The entries of a row, given where each row begins and, at the end, how many entries there are.
template <class Table>
constexpr IndexRange row(const Table& begins, Index i) {
    const auto at = static_cast<std::size_t>(i);
    return {begins[at], begins[at + 1]};
}

namespace detail {

constexpr std::int64_t plus(std::int64_t a, std::int64_t b) {
    return wrap_add(a, b);
}
template <std::floating_point R>
constexpr R plus(R a, R b) {
    return a + b;
}
constexpr std::int64_t times(std::int64_t a, std::int64_t b) {
    return wrap_mul(a, b);
}
template <std::floating_point R>
constexpr R times(R a, R b) {
    return a * b;
}
template <class A, class B>
requires SomePack<A, B> RDDL_INLINE auto plus(const A& a, const B& b) {
    if constexpr (std::floating_point<typename LanesOf<A, common_width<A, B>>::Element>)
        return a + b;
    else
        return wrap_add(a, b);
}
template <class A, class B>
requires SomePack<A, B> RDDL_INLINE auto times(const A& a, const B& b) {
    if constexpr (std::floating_point<typename LanesOf<A, common_width<A, B>>::Element>)
        return a * b;
    else
        return wrap_mul(a, b);
}

// Whether `a` replaces `best`: the first of equals stays, and so does the first nan.
struct WinsMinimum {
    constexpr auto operator()(auto a, auto best) const {
        return a < best || (is_nan(a) && !is_nan(best));
    }
};
struct WinsMaximum {
    constexpr auto operator()(auto a, auto best) const {
        return a > best || (is_nan(a) && !is_nan(best));
    }
};

template <class Int, class Body, class Wins>
constexpr Int arg_best(Index n, Body& body, Wins wins) {
    Int best{0};
    auto best_value = body(Index{0});
    for (Index i = 1; i < n; ++i) {
        const auto value = body(i);
        const auto better = wins(value, best_value);
        best = select(better, Int{i}, best);
        best_value = select(better, value, best_value);
    }
    return best;
}

}  // namespace detail

template <class T, class Body>
constexpr T sum(IndexRange range, Body&& body) {
    T total{0};
    for (Index i = range.begin; i < range.end; ++i) {
        // Reals are added one after the other, so that registers would only gather the few of a
        // row.
        if (std::floating_point<T> && !__builtin_constant_p(range.end)) asm volatile("");
        total = detail::plus(total, body(i));
    }
    return total;
}

template <class T, class Body>
constexpr T product(IndexRange range, Body&& body) {
    T total{1};
    for (Index i = range.begin; i < range.end; ++i) total = detail::times(total, body(i));
    return total;
}

template <class T, class Body>
constexpr T minimum_over(Index n, Body&& body) {
    T best = body(Index{0});
    for (Index i = 1; i < n; ++i) best = minimum(best, body(i));
    return best;
}

template <class T, class Body>
constexpr T maximum_over(Index n, Body&& body) {
    T best = body(Index{0});
    for (Index i = 1; i < n; ++i) best = maximum(best, body(i));
    return best;
}

template <class Bool, class Body>
constexpr Bool for_all(IndexRange range, Body&& body) {
    if constexpr (std::is_same_v<Bool, bool>) {
        // The counter is as wide as the numbers that most bodies compare, of which compilers then
        // take several at once.
        std::int64_t exceptions = 0;
        for (Index i = range.begin; i < range.end; ++i) exceptions |= body(i) ? 0 : 1;
        return exceptions == 0;
    } else {
        Bool all{true};
        for (Index i = range.begin; i < range.end; ++i) all = Bool(all & body(i));
        return all;
    }
}

template <class Bool, class Body>
constexpr Bool exists(IndexRange range, Body&& body) {
    Bool any{false};
    for (Index i = range.begin; i < range.end; ++i) any = Bool(any | body(i));
    return any;
}

template <class Int, class Body>
constexpr Int arg_min(Index n, Body&& body) {
    return detail::arg_best<Int>(n, body, detail::WinsMinimum{});
}

template <class Int, class Body>
constexpr Int arg_max(Index n, Body&& body) {
    return detail::arg_best<Int>(n, body, detail::WinsMaximum{});
}

}  // namespace rddl
