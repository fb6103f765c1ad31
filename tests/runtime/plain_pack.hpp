// A pack of reals as arrays and loops: the least that rddl/lanes/real.hpp asks of one.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace rddl::plain {

inline constexpr std::size_t width = 4;

template <class Function>
constexpr auto in_each_lane(Function function) {
    std::array<decltype(function(std::size_t{0})), width> lanes{};
    for (std::size_t i = 0; i < width; ++i) lanes[i] = function(i);
    return lanes;
}

struct Mask {
    std::array<bool, width> lanes;

    friend Mask operator!(Mask a) {
        return {in_each_lane([&](auto i) { return !a.lanes[i]; })};
    }
    friend Mask operator&&(Mask a, Mask b) {
        return {in_each_lane([&](auto i) { return a.lanes[i] && b.lanes[i]; })};
    }
    friend Mask operator||(Mask a, Mask b) {
        return {in_each_lane([&](auto i) { return a.lanes[i] || b.lanes[i]; })};
    }
    friend bool any(Mask a) {
        bool result = false;
        for (const bool lane : a.lanes) result = result || lane;
        return result;
    }
};

struct BitPack {
    std::array<std::uint64_t, width> lanes;

    BitPack(std::uint64_t a) { lanes.fill(a); }
    BitPack(std::array<std::uint64_t, width> a) : lanes(a) {}

    friend BitPack operator+(BitPack a, BitPack b) {
        return in_each_lane([&](auto i) { return a.lanes[i] + b.lanes[i]; });
    }
    friend BitPack operator-(BitPack a, BitPack b) {
        return in_each_lane([&](auto i) { return a.lanes[i] - b.lanes[i]; });
    }
    friend BitPack operator&(BitPack a, BitPack b) {
        return in_each_lane([&](auto i) { return a.lanes[i] & b.lanes[i]; });
    }
    friend BitPack operator|(BitPack a, BitPack b) {
        return in_each_lane([&](auto i) { return a.lanes[i] | b.lanes[i]; });
    }
    friend BitPack operator^(BitPack a, BitPack b) {
        return in_each_lane([&](auto i) { return a.lanes[i] ^ b.lanes[i]; });
    }
    friend BitPack operator<<(BitPack a, int count) {
        return in_each_lane([&](auto i) { return a.lanes[i] << count; });
    }
    friend BitPack operator>>(BitPack a, int count) {
        return in_each_lane([&](auto i) { return a.lanes[i] >> count; });
    }
};

struct RealPack {
    using Element = double;
    std::array<double, width> lanes;

    RealPack(double a) { lanes.fill(a); }
    RealPack(std::array<double, width> a) : lanes(a) {}

    friend RealPack operator-(RealPack a) {
        return in_each_lane([&](auto i) { return -a.lanes[i]; });
    }
    friend RealPack operator+(RealPack a, RealPack b) {
        return in_each_lane([&](auto i) { return a.lanes[i] + b.lanes[i]; });
    }
    friend RealPack operator-(RealPack a, RealPack b) {
        return in_each_lane([&](auto i) { return a.lanes[i] - b.lanes[i]; });
    }
    friend RealPack operator*(RealPack a, RealPack b) {
        return in_each_lane([&](auto i) { return a.lanes[i] * b.lanes[i]; });
    }
    friend RealPack operator/(RealPack a, RealPack b) {
        return in_each_lane([&](auto i) { return a.lanes[i] / b.lanes[i]; });
    }
    friend RealPack first_if_even(BitPack bits, RealPack a, RealPack b) {
        return in_each_lane(
            [&](auto i) { return bits.lanes[i] % 2 == 0 ? a.lanes[i] : b.lanes[i]; });
    }
    friend Mask operator==(RealPack a, RealPack b) {
        return {in_each_lane([&](auto i) { return a.lanes[i] == b.lanes[i]; })};
    }
    friend Mask operator!=(RealPack a, RealPack b) {
        return {in_each_lane([&](auto i) { return a.lanes[i] != b.lanes[i]; })};
    }
    friend Mask operator<(RealPack a, RealPack b) {
        return {in_each_lane([&](auto i) { return a.lanes[i] < b.lanes[i]; })};
    }
    friend Mask operator<=(RealPack a, RealPack b) {
        return {in_each_lane([&](auto i) { return a.lanes[i] <= b.lanes[i]; })};
    }
    friend Mask operator>(RealPack a, RealPack b) { return b < a; }
    friend Mask operator>=(RealPack a, RealPack b) { return b <= a; }

    friend RealPack select(Mask mask, RealPack a, RealPack b) {
        return in_each_lane([&](auto i) { return mask.lanes[i] ? a.lanes[i] : b.lanes[i]; });
    }
    friend RealPack absolute(RealPack a) {
        return in_each_lane([&](auto i) { return std::fabs(a.lanes[i]); });
    }
    friend RealPack sqrt(RealPack a) {
        return in_each_lane([&](auto i) { return std::sqrt(a.lanes[i]); });
    }
    friend BitPack bits_of(RealPack a) {
        return in_each_lane([&](auto i) { return std::bit_cast<std::uint64_t>(a.lanes[i]); });
    }
    template <class Function>
    friend RealPack map_lanes(RealPack a, Function function) {
        return in_each_lane([&](auto i) { return function(a.lanes[i]); });
    }
    template <class Function>
    friend RealPack map_lanes(RealPack a, RealPack b, Function function) {
        return in_each_lane([&](auto i) { return function(a.lanes[i], b.lanes[i]); });
    }
    template <class Function>
    friend RealPack replace_lanes(Mask replaced, RealPack a, RealPack others, Function function) {
        return in_each_lane(
            [&](auto i) { return replaced.lanes[i] ? function(a.lanes[i]) : others.lanes[i]; });
    }
};

inline RealPack real_of_bits(BitPack a) {
    return in_each_lane([&](auto i) { return std::bit_cast<double>(a.lanes[i]); });
}

}  // namespace rddl::plain
