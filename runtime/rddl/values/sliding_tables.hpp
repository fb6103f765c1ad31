// Tables of reals whose elements move one place towards the front of their rows in each step.
//
// One environment moves the elements. Packs, whose tables take that many times the memory, leave
// them where they are: both records of a block use one sliding buffer, in which the table begins
// one element further on in each step, so that the rows end where others have begun. At the end of
// the buffer all elements are moved back. Records whose tables lie in sliding buffers are settled
// before others than emitted code read or write them.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/lanes/pack.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/moderate.hpp>
#include <rddl/values/ops.hpp>
#include <rddl/values/pack_ops.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>

namespace rddl {

// Stands in a record of the state behind its tables.
struct NoSlidingBuffer {};
inline constexpr NoSlidingBuffer no_sliding_buffer{};
template <class Real, class Table>
struct SlidingBufferOf {
    static constexpr std::size_t count = sizeof(Table) / sizeof(Real);

    std::int64_t place;  // bytes from the record's table to where it is now; 0: it is there
    std::int64_t
        steps;  // before it reaches the end of the buffer; if it is there, since it was settled
    bool has_great;            // an element there may be no moderate number
    Real elements[2 * count];  // tables of either record may lie here
};
template <class L, class Table>
using SlidingBuffer =
    std::conditional_t<L::width == 1, NoSlidingBuffer, SlidingBufferOf<typename L::Real, Table>>;

// Bytes of a record.
template <class Buffer>
inline constexpr std::size_t bytes_of_sliding_buffer = std::is_empty_v<Buffer> ? 0 : sizeof(Buffer);

// The table of a record.
template <class Table>
RDDL_INLINE Table& window(Table& table, const NoSlidingBuffer&) {
    return table;
}
template <class Real, class Table>
RDDL_ALWAYS_INLINE Table& window(Table& table, const SlidingBufferOf<Real, Table>& buffer) {
    return *reinterpret_cast<Table*>(reinterpret_cast<std::byte*>(&table) + buffer.place);
}
template <class Real, class Table>
RDDL_ALWAYS_INLINE const Table& window(const Table& table,
                                       const SlidingBufferOf<Real, Table>& buffer) {
    return *reinterpret_cast<const Table*>(reinterpret_cast<const std::byte*>(&table) +
                                           buffer.place);
}

// The table comes back from a buffer, if it is in one.
template <class Table>
void settle(Table&, const NoSlidingBuffer&) {}
template <class Real, class Table>
void settle(Table& table, SlidingBufferOf<Real, Table>& buffer) {
    if (buffer.place != 0) table = window(table, buffer);
    buffer.place = buffer.steps = 0;
}
// A table that is settled again after a few steps had better not be moved to a buffer.
inline constexpr std::int64_t steps_before_sliding = 4;

// The same as is_moderate, for a table that may lie in a sliding buffer.
template <class L, class Table, class Buffer>
RDDL_ALWAYS_INLINE typename L::Bool is_moderate(const Table& table, const Buffer& buffer) {
    if constexpr (!std::is_empty_v<Buffer>)
        if (buffer.place != 0 && !buffer.has_great) [[likely]]
            return true;
    return is_moderate<L>(window(table, buffer));
}

namespace detail {

template <class Real, class Table>
RDDL_INLINE const Real* first_real(const Table& table) {
    return reinterpret_cast<const Real*>(&table);
}
// Element i becomes element i + 1, except the last one; -0.0 becomes 0.0.
template <std::size_t count, class Real>
RDDL_INLINE void move_to_front(const Real* __restrict from, Real* __restrict to) {
    if constexpr (std::is_arithmetic_v<Real>) {
        using Some = Lanes<Real, simd::lanes_of<Real>>;
        constexpr std::size_t width = Some::width;
        const auto move = [=](std::size_t i) RDDL_INLINE_LAMBDA {
            (Some(Real(0.0)) + Some::load(from + i + 1)).store(to + i);
        };
        if constexpr (count > width) {  // the last ones with some of those before
            for (std::size_t i = 0; i + width < count; i += width) move(i);
            return move(count - 1 - width);
        }
    }
    for (std::size_t i = 0; i + 1 < count; ++i) to[i] = Real(0.0) + from[i + 1];
}
template <std::size_t row, std::size_t count, class Real>
RDDL_INLINE void clear_ends(Real* table) {
    for (std::size_t end = row; end <= count; end += row) table[end - 1] = Real(0.0);
}

}  // namespace detail

// In rows of so many elements, each one of `to` becomes 0.0 + the one of `from` behind it, and the
// last one 0.0. Both are tables of the records of a state and its next one. That of the state is
// lost: where all lanes run, it lies in the same buffer.
template <std::size_t row, class L, class Table>
RDDL_INLINE void shift(const Context<L>&, const Table& from, const NoSlidingBuffer&, Table& to,
                       const NoSlidingBuffer&) {
    using Real = typename L::Real;
    constexpr std::size_t count = sizeof(Table) / sizeof(Real);
    Real* const elements = const_cast<Real*>(detail::first_real<Real>(to));
    detail::move_to_front<count>(detail::first_real<Real>(from), elements);
    detail::clear_ends<row, count>(elements);
}
template <std::size_t row, class L, class Real, class Table>
RDDL_ALWAYS_INLINE void shift(const Context<L>& context, const Table& from,
                              const SlidingBufferOf<Real, Table>& from_buffer, Table& to,
                              SlidingBufferOf<Real, Table>& buffer) {
    constexpr std::size_t count = SlidingBufferOf<Real, Table>::count;
    const Real* const source = detail::first_real<Real>(window(from, from_buffer));
    const bool all_run = all(context.active);
    const bool slides = from_buffer.place != 0;
    Real* elements = buffer.elements;
    if (all_run && slides && from_buffer.steps > 0) [[likely]] {
        elements = const_cast<Real*>(source + 1);
        buffer.steps = from_buffer.steps - 1;
    } else {
        const bool will_slide = all_run && (slides || from_buffer.steps >= steps_before_sliding);
        if (!will_slide) elements = const_cast<Real*>(detail::first_real<Real>(to));
        detail::move_to_front<count>(source, elements);
        buffer.steps =
            will_slide ? static_cast<std::int64_t>(count) : (all_run ? from_buffer.steps + 1 : 0);
    }
    buffer.place = reinterpret_cast<std::byte*>(elements) - reinterpret_cast<std::byte*>(&to);
    buffer.has_great = false;
    detail::clear_ends<row, count>(elements);
}

// A term of the element at a place of a row; of none, if there is no such place.
template <class Int, class Real>
struct Added {
    Int place;
    Real term;
};
template <class Int, class Real>
Added(Int, Real) -> Added<Int, Real>;

namespace detail {

// 0.0 + (the terms of this place, which stand in their order, + the element)
template <class Int, class Real, class... Terms>
RDDL_INLINE Real with_terms(const Int& place, const Real& element, const Terms&... terms) {
    Real sum{-0.0};
    const auto add = [&](const auto& each) RDDL_INLINE_LAMBDA {
        sum = sum + select(each.place == place, Real(each.term), Real(0.0));
    };
    (add(terms), ...);
    return Real(0.0) + (sum + element);
}

// The places of the lanes of elements that differ between the lanes, one real after the other.
template <int n>
inline constexpr auto lane_places = [] {
    std::array<std::int64_t, static_cast<std::size_t>(n)> places{};
    for (std::size_t lane = 0; lane < places.size(); ++lane)
        places[lane] = static_cast<std::int64_t>(lane);
    return places;
}();
template <int n>
RDDL_INLINE Lanes<std::int64_t, n> places_of_lanes(const Lanes<std::int64_t, n>& places) {
    using Int = Lanes<std::int64_t, n>;
    return (places << std::countr_zero(unsigned{n})) + Int::load(lane_places<n>.data());
}
template <class R, int n>
RDDL_INLINE Lanes<R, n> gather_lanes(const Lanes<R, n>* elements,
                                     const Lanes<std::int64_t, n>& places) {
    const R* const first = reinterpret_cast<const R*>(elements);
#ifdef RDDL_SIMD_AVX512
    if constexpr (std::is_same_v<R, double>)
        return Lanes<R, n>::each(
            [first](auto part) RDDL_INLINE_LAMBDA { return simd::gather(first, part); }, places);
#endif
    Lanes<R, n> values;
    for (int lane = 0; lane < n; ++lane) values.set(lane, first[places[lane]]);
    return values;
}
// Where the mask holds.
template <class R, int n>
RDDL_INLINE void scatter_lanes(const Lanes<R, n>& values, Mask<n> mask,
                               const Lanes<std::int64_t, n>& places, Lanes<R, n>* elements) {
    R* const first = reinterpret_cast<R*>(elements);
#ifdef RDDL_SIMD_AVX512
    if constexpr (std::is_same_v<R, double>) {
        for (int p = 0; p < places.part_count; ++p) {
            const auto some = static_cast<__mmask8>(std::uint64_t{mask.bits} >> (p * simd::lanes));
            _mm512_mask_i64scatter_pd(first, some, (__m512i)places.part[p], (__m512d)values.part[p],
                                      8);
        }
        return;
    }
#endif
    for_each_lane(mask, [&](int lane) { first[places[lane]] = values[lane]; });
}

// All sums are read before one is written.
template <std::size_t row, class Real, class... Terms>
RDDL_INLINE auto sums_in_row(const std::array<Real, row>& elements, const Terms&... terms) {
    const auto sum_at = [&](std::int64_t place) RDDL_INLINE_LAMBDA {
        if (static_cast<std::uint64_t>(place) >= row) return Real{};
        return with_terms(place, elements[static_cast<std::size_t>(place)], terms...);
    };
    return std::array{sum_at(terms.place)...};
}
// Calls look_at(element) for each that it changes.
template <std::size_t row, class Real, class Look, class... Terms>
RDDL_INLINE void add_at_places(std::array<Real, row>& elements, const Look& look_at,
                               const Terms&... terms) {
    const std::array sums = sums_in_row(elements, terms...);
    const auto put = [&](std::int64_t place, const Real& sum) RDDL_INLINE_LAMBDA {
        if (static_cast<std::uint64_t>(place) >= row) return;
        look_at(sum);
        elements[static_cast<std::size_t>(place)] = sum;
    };
    const Real* sum = sums.data();
    (put(terms.place, *sum++), ...);
}
// Each lane has places of its own.
template <std::size_t row, class R, int n, class Look, class... Terms>
RDDL_INLINE void add_at_own_places(std::array<Lanes<R, n>, row>& elements, const Look& look_at,
                                   const Terms&... terms) {
    using Int = Lanes<std::int64_t, n>;
    using Real = Lanes<R, n>;
    const auto is_there = [](const Int& place) RDDL_INLINE_LAMBDA {
        return place >= std::int64_t{0} && place < static_cast<std::int64_t>(row);
    };
    const auto sum_at = [&](const Int& place) RDDL_INLINE_LAMBDA {
        const Int somewhere = select(is_there(place), place, Int{0});
        return with_terms(place, gather_lanes(elements.data(), places_of_lanes(somewhere)),
                          terms...);
    };
    const auto put = [&](const Int& place, const Real& sum) RDDL_INLINE_LAMBDA {
        const Mask<n> there = is_there(place);
        look_at(select(there, sum, Real(0.0)));
        scatter_lanes(sum, there, places_of_lanes(place), elements.data());
    };
    // All are read before one is written.
    const std::array sums{sum_at(terms.place)...};
    const Real* sum = sums.data();
    (put(terms.place, *sum++), ...);
}

}  // namespace detail

// Adds terms to elements of a row that was shifted: these are 0.0 + (term + term + element), with
// 0.0 in place of the terms of other places.
template <std::size_t row, class R, class... Terms>
requires std::is_arithmetic_v<R> RDDL_INLINE void add_to_row(std::array<R, row>& elements,
                                                             const NoSlidingBuffer&,
                                                             const Terms&... terms) {
    detail::add_at_places(
        elements, [](R) {}, terms...);
}
// Where all lanes have the same places, these choose whole elements.
template <std::size_t row, class R, int n, class Buffer, class... Terms>
RDDL_ALWAYS_INLINE void add_to_row(std::array<Lanes<R, n>, row>& elements, Buffer& buffer,
                                   const Terms&... terms) {
    using Real = Lanes<R, n>;
    Mask<n> are_great = false;
    const auto look_at = [&](const Real& sum) RDDL_INLINE_LAMBDA {
        are_great = are_great || !(absolute(sum) <= Real(moderate));
    };
    if ((all(terms.place == Lanes<std::int64_t, n>{terms.place[0]}) && ...))
        detail::add_at_places(elements, look_at,
                              Added<std::int64_t, Real>{terms.place[0], terms.term}...);
    else
        detail::add_at_own_places(elements, look_at, terms...);
    if constexpr (!std::is_empty_v<Buffer>) buffer.has_great |= any(are_great);
}

}  // namespace rddl
