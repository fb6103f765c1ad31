// Sums over a row or table of bools in which the true ones alone count.
//
// One environment looks up which ones are true, 64 at a time, and visits no others. Packs of
// environments visit those that are true in one of theirs if the terms take long, else all.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/lanes/pack.hpp>
#include <rddl/lanes/simd_moves.hpp>
#include <rddl/values/bits.hpp>
#include <rddl/values/bool_rows.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/ops.hpp>
#include <rddl/values/pack_ops.hpp>
#include <rddl/values/reductions.hpp>
#include <rddl/values/tables.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace rddl {

// Holds the true elements of a row or table for a visit: the place of the first one, or n where all
// are false, and the bits of the others in words. Mostly there are no others.
template <std::size_t n>
struct TrueElements {
    Index first = static_cast<Index>(n);
    std::array<std::uint64_t, (n + 63) / 64> others;
    bool has_others = false;
};

namespace detail {

// Calls visit(first, bits) for 64 bools after the other: the first one of them, and their bits.
template <std::size_t n, class Visit>
RDDL_INLINE void for_each_word(const std::array<bool, n>& row, Visit&& visit) {
    constexpr Index size = static_cast<Index>(n);
    for (Index first = 0; first < size; first += 64)
        visit(first, simd::bits_of_stored_bytes(
                         row.data() + first, static_cast<int>(std::min<Index>(64, size - first))));
}

template <class Table>
RDDL_INLINE auto true_elements_of(const Table& table) {
    TrueElements<static_cast<std::size_t>(element_count<Table>)> elements{.others =
                                                                              words_of(table)};
    bool is_found = false;
    Index first_of_word = 0;
    for (std::uint64_t& bits : elements.others) {
        const bool is_here = !is_found && bits != 0;
        if (is_here) elements.first = first_of_word + __builtin_ctzll(bits);
        bits = is_here ? bits & (bits - 1) : bits;
        elements.has_others |= bits != 0;
        is_found |= is_here;
        first_of_word += 64;
    }
    return elements;
}

// The term where the only true bool of each lane is, 0.0 where none is; sum() of one environment,
// or where a lane may have several.
template <class T, class Bools, class Terms, class Sum>
RDDL_INLINE T term_of_each(const Bools& bools, const Terms& terms, Sum&& sum) {
    constexpr Index count = element_count<Bools>;
    if constexpr (std::is_floating_point_v<T> || count > 64) {
        return sum();
    } else {
        const auto word = bits(bools);
        using Word = std::remove_const_t<decltype(word)>;
        const Word none{std::int64_t{0}}, below = wrap_sub(word, Word{std::int64_t{1}});
        if (any(bit_and(word, below) != none)) return sum();
        constexpr auto others = static_cast<std::int64_t>((std::uint64_t{1} << (count - 1)) - 1);
        const Word place = count_ones(bit_and(below, Word{others}));
        const T term = gather<count>(first_element(terms), place);
        return select(word != none, term + T{0}, T{0});
    }
}

}  // namespace detail

// How many are true. Int.
template <std::size_t n>
RDDL_INLINE std::int64_t count_true(const std::array<bool, n>& row) {
    std::int64_t total = 0;
    detail::for_each_word(row,
                          [&](Index, std::uint64_t bits) { total += __builtin_popcountll(bits); });
    return total;
}
template <std::size_t n, int width>
RDDL_INLINE Lanes<std::int64_t, width> count_true(const std::array<Mask<width>, n>& row) {
    constexpr std::size_t last = n / 64 * 64;
    Lanes<std::int64_t, width> total{0};
    for (std::size_t first = 0; first < last; first += 64)
        total = wrap_add(total, count_ones(bits_in_lanes<64>(row.data() + first)));
    if constexpr (last < n)
        total = wrap_add(total, count_ones(bits_in_lanes<int{n - last}>(row.data() + last)));
    return total;
}

// The sum of body(i) over the true ones, in order. Sums of reals begin with 0.0, so that terms of
// 0.0 for the others would change nothing. With a context, the body may draw, fault or take long.
template <class T, std::size_t n, class Body>
RDDL_INLINE T sum_over_true(const std::array<bool, n>& row, Body&& body) {
    T total{0};
    detail::for_each_word(row, [&](Index first, std::uint64_t bits) {
        for (; bits != 0; bits &= bits - 1)
            total = detail::plus(total, body(first + __builtin_ctzll(bits)));
    });
    return total;
}
template <class T, class R, std::size_t n, class Body>
RDDL_INLINE T sum_over_true(Context<ScalarOf<R>>&, const std::array<bool, n>& row, Body&& body) {
    return sum_over_true<T>(row, body);
}
template <class T, std::size_t n, int width, class Body>
RDDL_INLINE T sum_over_true(const std::array<Mask<width>, n>& row, Body&& body) {
    return sum<T>(static_cast<Index>(n),
                  [&](Index i) { return select(row[static_cast<std::size_t>(i)], body(i), T{0}); });
}
template <class T, class L, std::size_t n, int width, class Body>
RDDL_INLINE T sum_over_true(Context<L>& context, const std::array<Mask<width>, n>& row,
                            Body&& body) {
    constexpr std::size_t tested_at_once = 32;
    T total{0};
    const auto add = [&](std::size_t i) RDDL_INLINE_LAMBDA {
        const T term = branch(
            context, row[i], [&] { return T(body(static_cast<Index>(i))); }, [&] { return T{0}; });
        total = detail::plus(total, term);
    };
    for (std::size_t first = 0; first < n; first += tested_at_once) {
        const std::size_t end = std::min(n, first + tested_at_once);
        Mask<width> some = row[first];
        for (std::size_t i = first; i < end; ++i) some = some || row[i];
        for (std::size_t i = first; any(some) && i < end; ++i)
            if (any(row[i])) add(i);
    }
    return total;
}

// The sum of sums, one for each row of a table, over body(x, y) of its true elements. A row without
// any would add 0.0. In packs the rows are summed up as above.
template <class T, std::size_t m, std::size_t n, class Body>
RDDL_INLINE T sum_over_true(const std::array<std::array<bool, n>, m>& table, Body&& body) {
    constexpr Index size = static_cast<Index>(n);
    const auto elements = detail::true_elements_of(table);
    if (elements.first == static_cast<Index>(m * n)) return T{0};
    Index row = elements.first / size;
    T total{0}, of_row = detail::plus(T{0}, body(row, elements.first % size));
    detail::for_each_one(elements.others, [&](Index place) RDDL_INLINE_LAMBDA {
        const Index x = place / size;
        if (x != row) total = detail::plus(total, std::exchange(of_row, T{0}));
        row = x;
        of_row = detail::plus(of_row, body(x, place % size));
    });
    return detail::plus(total, of_row);
}
template <class T, class R, std::size_t m, std::size_t n, class Body>
RDDL_INLINE T sum_over_true(Context<ScalarOf<R>>&, const std::array<std::array<bool, n>, m>& table,
                            Body&& body) {
    return sum_over_true<T>(table, body);
}
template <class T, std::size_t m, std::size_t n, int width, class Body>
RDDL_INLINE T sum_over_true(const std::array<std::array<Mask<width>, n>, m>& table, Body&& body) {
    return sum<T>(static_cast<Index>(m), [&](Index x) RDDL_INLINE_LAMBDA {
        return sum_over_true<T>(table[static_cast<std::size_t>(x)],
                                [&](Index y) { return body(x, y); });
    });
}
template <class T, class L, std::size_t m, std::size_t n, int width, class Body>
RDDL_INLINE T sum_over_true(Context<L>& context,
                            const std::array<std::array<Mask<width>, n>, m>& table, Body&& body) {
    return sum<T>(static_cast<Index>(m), [&](Index x) RDDL_INLINE_LAMBDA {
        return sum_over_true<T>(context, table[static_cast<std::size_t>(x)],
                                [&](Index y) { return body(x, y); });
    });
}

// The same sums with the elements of a table of constants as terms. Mostly at most one bool of an
// environment is true: then each environment of a pack looks up its own term.
template <class T, std::size_t n, class Bool, class R>
RDDL_INLINE T sum_where_true(const std::array<Bool, n>& row, const std::array<R, n>& terms) {
    return detail::term_of_each<T>(row, terms, [&] {
        return sum_over_true<T>(row, [&](Index i) { return terms[static_cast<std::size_t>(i)]; });
    });
}
template <class T, std::size_t m, std::size_t n, class Bool, class R>
RDDL_INLINE T sum_where_true(const std::array<std::array<Bool, n>, m>& table,
                             const std::array<std::array<R, n>, m>& terms) {
    return detail::term_of_each<T>(table, terms, [&] {
        return sum_over_true<T>(table, [&](Index x, Index y) {
            return terms[static_cast<std::size_t>(x)][static_cast<std::size_t>(y)];
        });
    });
}

// The true elements of a row for a visit; packs take the row as it is.
template <std::size_t n>
RDDL_INLINE TrueElements<n> true_elements(const std::array<bool, n>& row) {
    return detail::true_elements_of(row);
}
template <std::size_t n, int width>
RDDL_INLINE const std::array<Mask<width>, n>& true_elements(const std::array<Mask<width>, n>& row) {
    return row;
}

// Calls mark(x, is_true) for all x that are true, in packs for those that are true in one of the
// environments.
template <std::size_t n, class Mark>
RDDL_INLINE void visit_true(const TrueElements<n>& elements, Mark&& mark) {
    if (elements.first == static_cast<Index>(n)) return;
    mark(elements.first, true);
    // A call of its own, so that the marks stand in the step only once.
    if (elements.has_others) [[unlikely]]
        [&]() __attribute__((noinline)) {
            detail::for_each_one(elements.others, [&](Index x) { mark(x, true); });
        }
    ();
}
template <std::size_t n, int width, class Mark>
RDDL_INLINE void visit_true(const std::array<Mask<width>, n>& elements, Mark&& mark) {
    for (Index x = 0; x < static_cast<Index>(n); ++x) {
        const Mask<width> is_true = elements[static_cast<std::size_t>(x)];
        if (any(is_true)) mark(x, is_true);
    }
}
// The same with mark(x, entry, is_true) for each entry of the rows of all these x.
template <class Elements, class Rows, class Mark>
RDDL_INLINE void visit_true(const Elements& elements, const Rows& rows, Mark&& mark) {
    visit_true(elements, [&](Index x, const auto& is_true) RDDL_INLINE_LAMBDA {
        for (Index entry = rows[x]; entry < rows[x + 1]; ++entry) mark(x, entry, is_true);
    });
}

// The visits by first() and then by second(), which may take turns where one x alone is true: then
// its entries are visited once.
template <std::size_t n, class Rows, class First, class Second>
RDDL_INLINE void visit_true_in_turn(const TrueElements<n>& elements, const Rows& rows,
                                    First&& first, Second&& second) {
    const Index x = elements.first;
    if (x == static_cast<Index>(n)) return;
    // A call of its own, so that the marks stand in the step only once.
    if (elements.has_others) [[unlikely]]
        return [&]() __attribute__((noinline)) {
            visit_true(elements, rows, first);
            visit_true(elements, rows, second);
        }
    ();
    for (Index entry = rows[x]; entry < rows[x + 1]; ++entry) {
        first(x, entry, true);
        second(x, entry, true);
    }
}
template <std::size_t n, int width, class Rows, class First, class Second>
RDDL_INLINE void visit_true_in_turn(const std::array<Mask<width>, n>& elements, const Rows& rows,
                                    First&& first, Second&& second) {
    visit_true(elements, rows, first);
    visit_true(elements, rows, second);
}

// Gives an element the value where the condition is true.
template <bool value>
RDDL_INLINE void mark(bool& element, bool condition) {
    if (condition) element = value;
}
template <bool value, int width>
RDDL_INLINE void mark(Mask<width>& element, Mask<width> condition) {
    element = value ? element || condition : element && !condition;
}

}  // namespace rddl
