// Which interval between sorted constant thresholds a uniform number lies in, by a guide table: the
// thresholds are so far apart that at most one lies inside of each of a few equal parts of [0, 1).
// H.-C. Chen, Y. Asau, "On generating random variates from an empirical distribution", AIIE
// Transactions 6, 1974.
#pragma once

#include <rddl/values/ops.hpp>
#include <rddl/values/pack_ops.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace rddl::sample::detail {

template <const auto& thresholds>
struct GuideTable {
    using R = typename std::remove_cvref_t<decltype(thresholds)>::value_type;
    static constexpr std::size_t most_parts = 32;  // registers hold their tables

    static constexpr bool is_inside(R threshold, std::size_t part, std::size_t count) {
        return threshold * static_cast<R>(count) > static_cast<R>(part) &&
               threshold * static_cast<R>(count) < static_cast<R>(part + 1);
    }
    static constexpr bool separates(std::size_t count) {
        for (std::size_t part = 0; part < count; ++part) {
            int found = 0;
            for (const R threshold : thresholds) found += is_inside(threshold, part, count);
            if (found > 1) return false;
        }
        return true;
    }
    // A power of 2, so that products with it are exact; 0: there is no guide table.
    static constexpr std::size_t parts = [] {
        for (std::size_t count = 8; count <= most_parts; count *= 2)
            if (separates(count)) return count;
        return std::size_t{0};
    }();

    // How many thresholds the numbers of each part have reached, and the one inside of the part. A
    // part without a threshold has 2, which no number reaches.
    static constexpr std::array<std::int64_t, parts> reached = [] {
        std::array<std::int64_t, parts> counts{};
        for (std::size_t part = 0; part < parts; ++part)
            for (const R threshold : thresholds)
                counts[part] += threshold * static_cast<R>(parts) <= static_cast<R>(part);
        return counts;
    }();
    static constexpr std::array<R, parts> inside = [] {
        std::array<R, parts> found{};
        for (std::size_t part = 0; part < parts; ++part) {
            found[part] = 2;
            for (const R threshold : thresholds)
                if (is_inside(threshold, part, parts)) found[part] = threshold;
        }
        return found;
    }();

    // How many thresholds are at most a number in [0, 1).
    template <class Int, class Real>
    static RDDL_INLINE Int count(const Real& number) {
        const Int part = truncate_to_int(number * static_cast<R>(parts));
        return wrap_add(at(reached, part), to_int(at(inside, part) <= number));
    }
};

}  // namespace rddl::sample::detail
