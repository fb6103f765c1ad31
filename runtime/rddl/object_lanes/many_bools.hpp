// Bools of many objects in vector registers.
//
// They lie there as they lie in tables: for one environment a byte of 0 or 1 for each object, for
// packs the mask of each object's environments. So loading and storing them takes no conversion,
// and a connective is one instruction for a whole register.
#pragma once

#include <rddl/lanes/pack.hpp>
#include <rddl/lanes/simd.hpp>
#include <rddl/lanes/simd_bytes.hpp>
#include <rddl/values/bits.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace rddl::inline RDDL_SIMD_LEVEL {

// The element of a register that holds an object's bool, and its value for true.
template <class Bool>
struct InRegister;
template <>
struct InRegister<bool> {
    using Element = std::uint8_t;
    static constexpr Element yes = 1;
};
template <int n>
struct InRegister<Mask<n>> {
    using Element = typename Mask<n>::Bits;
    static constexpr Element yes = static_cast<Element>(~Element{0});
};

// The bools of few objects of one environment need no more than a small register.
inline constexpr int bytes_of_few = 16;

template <class T, int bytes>
struct RegisterOf {
    static constexpr std::size_t count = bytes / sizeof(T);
    typedef T type __attribute__((vector_size(bytes)));
};

// The bools of n objects; elements behind them have any value.
template <class Bool, int n>
struct ManyBools {
    using Element = typename InRegister<Bool>::Element;
    static constexpr int part_bytes =
        std::is_same_v<Bool, bool> && n <= bytes_of_few ? bytes_of_few : simd::register_bytes;
    using Vector = typename RegisterOf<Element, part_bytes>::type;
    static constexpr Element yes = InRegister<Bool>::yes;
    static constexpr int part_width = part_bytes / static_cast<int>(sizeof(Element));
    static constexpr int part_count = (n + part_width - 1) / part_width;

    Vector part[part_count];

    ManyBools() = default;
    RDDL_INLINE ManyBools(bool everywhere) : ManyBools(filled(everywhere ? yes : Element{0})) {}
    // The same mask for all objects.
    template <int lanes>
    requires std::is_same_v<Mask<lanes>, Bool> RDDL_INLINE ManyBools(Mask<lanes> everywhere)
        : ManyBools(filled(everywhere.bits)) {}

    template <class Operation, class... Operands>
    static RDDL_INLINE ManyBools each(Operation operation, const Operands&... operands) {
        ManyBools result;
        for (int p = 0; p < part_count; ++p) result.part[p] = operation(operands.part[p]...);
        return result;
    }
    // Makes each register by make.template operator()<part, count>(), `count` being that of the
    // objects in it.
    template <class Make>
    static RDDL_INLINE ManyBools of_parts(Make make) {
        ManyBools result;
        for_each_part([&]<int p, int count>() RDDL_INLINE_LAMBDA {
            result.part[p] = make.template operator()<p, count>();
        });
        return result;
    }
    template <class Body>
    static RDDL_INLINE void for_each_part(Body body) {
        [&]<std::size_t... p>(std::index_sequence<p...>) RDDL_INLINE_LAMBDA {
            (body.template operator()<static_cast<int>(p), count_in(static_cast<int>(p))>(), ...);
        }
        (std::make_index_sequence<part_count>());
    }

    friend RDDL_INLINE ManyBools operator&&(const ManyBools& a, const ManyBools& b) {
        return each([](Vector x, Vector y) RDDL_INLINE_LAMBDA { return x & y; }, a, b);
    }
    friend RDDL_INLINE ManyBools operator||(const ManyBools& a, const ManyBools& b) {
        return each([](Vector x, Vector y) RDDL_INLINE_LAMBDA { return x | y; }, a, b);
    }
    friend RDDL_INLINE ManyBools operator!(const ManyBools& a) { return a != ManyBools(true); }
    friend RDDL_INLINE ManyBools operator==(const ManyBools& a, const ManyBools& b) {
        return !(a != b);
    }
    friend RDDL_INLINE ManyBools operator!=(const ManyBools& a, const ManyBools& b) {
        return each([](Vector x, Vector y) RDDL_INLINE_LAMBDA { return x ^ y; }, a, b);
    }
    static RDDL_INLINE ManyBools select(const ManyBools& condition, const ManyBools& a,
                                        const ManyBools& b) {
        return each([](Vector c, Vector x, Vector y)
                        RDDL_INLINE_LAMBDA { return (x & c) | (y & ~c); },
                    condition, a, b);
    }

  private:
    static constexpr int count_in(int part) {
        return part + 1 < part_count ? part_width : n - part * part_width;
    }
    static RDDL_INLINE ManyBools filled(Element everywhere) {
        return each([everywhere]() RDDL_INLINE_LAMBDA { return everywhere - Vector{}; });
    }
};

// Whether the bytes that a caller has given for bools are not 0 (bits.hpp).
template <int n>
RDDL_INLINE ManyBools<bool, n> is_true(const ManyBools<bool, n>& given) {
    using Vector = typename ManyBools<bool, n>::Vector;
    return ManyBools<bool, n>::each(
        [](Vector x) RDDL_INLINE_LAMBDA { return simd::reinterpret<Vector>(x != 0) & 1; }, given);
}
template <int lanes, int n>
RDDL_INLINE ManyBools<Mask<lanes>, n> is_true(const ManyBools<Mask<lanes>, n>& given) {
    return given;
}

template <class T>
inline constexpr bool is_many_bools = false;
template <class Bool, int n>
inline constexpr bool is_many_bools<ManyBools<Bool, n>> = true;

// ---------------------------------------------------------------------------------- memory

// The bools of n objects that lie one after the other; no more is read or written.
template <int n, class Bool>
RDDL_INLINE ManyBools<Bool, n> load_many(const Bool* from) {
    using Many = ManyBools<Bool, n>;
    return Many::of_parts([&]<int p, int count>() RDDL_INLINE_LAMBDA {
        constexpr int bytes = count * static_cast<int>(sizeof(Bool));
        return simd::load_bytes<typename Many::Vector, bytes>(from + p * Many::part_width);
    });
}
template <class Bool, int n>
RDDL_INLINE void store_many(const ManyBools<Bool, n>& values, Bool* to) {
    using Many = ManyBools<Bool, n>;
    Many::for_each_part([&]<int p, int count>() RDDL_INLINE_LAMBDA {
        constexpr int bytes = count * static_cast<int>(sizeof(Bool));
        simd::store_bytes<bytes>(values.part[p], to + p * Many::part_width);
    });
}

// Whether one is true.
template <int lanes, int n>
RDDL_INLINE bool any_of_many(const ManyBools<Mask<lanes>, n>& values) {
    bool is_any = false;
    ManyBools<Mask<lanes>, n>::for_each_part([&]<int p, int count>() RDDL_INLINE_LAMBDA {
        constexpr int bytes = count * static_cast<int>(sizeof(Mask<lanes>));
        is_any |= simd::is_any_byte<bytes>(values.part[p]);
    });
    return is_any;
}

// Bools that all environments share.
template <class Bool, int n>
RDDL_INLINE ManyBools<Bool, n> spread_many(const bool* from) {
    using Many = ManyBools<Bool, n>;
    if constexpr (std::is_same_v<Bool, bool>) {
        if (!__builtin_constant_p(from[0])) return load_many<n>(from);
        return Many::of_parts([&]<int p, int count>() RDDL_INLINE_LAMBDA {
            return simd::load_constant_bytes<typename Many::Vector, count>(from +
                                                                           p * Many::part_width);
        });
    } else {
        typedef std::int8_t Bytes __attribute__((vector_size(Many::part_width)));
        return Many::of_parts([&]<int p, int count>() RDDL_INLINE_LAMBDA {
            Bytes bytes{};
            __builtin_memcpy(&bytes, from + p * Many::part_width, count);
            return __builtin_convertvector(-bytes, typename Many::Vector);
        });
    }
}

namespace many_bools {

#ifdef RDDL_SIMD_AVX512
// Masks of 16 bits, of a table of at most 128; the first `count` of the register.
template <std::int64_t size, int count, class Place>
RDDL_INLINE __m512i gathered_pairs(const void* table, const Place* from) {
    constexpr std::uint32_t all = ~std::uint32_t{0}, there = all >> (32 - count);
    __m512i places;
    if constexpr (sizeof(Place) == 1)
        places = _mm512_maskz_cvtepu8_epi16(all, _mm256_maskz_loadu_epi8(there, from));
    else
        places = _mm512_maskz_loadu_epi16(there, from);
    const auto part = [&](int first) RDDL_INLINE_LAMBDA {
        const int rest = static_cast<int>(size) - first;
        return simd::load_many_parts(static_cast<const char*>(table) + 2 * first,
                                     rest < 32 ? 2 * rest : 64);
    };
    const auto chosen = [&]<int first, int rest>() RDDL_INLINE_LAMBDA {
        if constexpr (rest <= 32)
            return _mm512_maskz_permutexvar_epi16(all, places, part(first));
        else
            return _mm512_maskz_permutex2var_epi16(all, part(first), places, part(first + 32));
    };
    const __m512i in_first = chosen.template operator()<0, size>();
    if constexpr (size <= 64)
        return in_first;
    else
        return _mm512_mask_mov_epi16(in_first,
                                     _mm512_test_epi16_mask(places, _mm512_set1_epi16(64)),
                                     chosen.template operator()<64, size - 64>());
}
#endif

template <class Vector, class Bool, class Place, std::size_t... i>
RDDL_INLINE Vector chosen(const Bool* table, const Place* places, std::size_t count,
                          std::index_sequence<i...>) {
    const auto element = [&](std::size_t place) RDDL_INLINE_LAMBDA {
        typename InRegister<Bool>::Element bits;
        __builtin_memcpy(&bits, table + place, sizeof bits);
        return bits;
    };
    return Vector{element(places[i < count ? i : 0])...};
}

// The masks of `count` objects from a table of `size`, by places of any kind.
template <class Vector, std::int64_t size, int count, class Bool, class Place>
RDDL_INLINE Vector gathered(const Bool* table, const Place* places) {
#ifdef RDDL_SIMD_AVX512
    if constexpr (sizeof(Bool) == 2 && sizeof(Place) <= 2 && size <= 128) {
        return simd::reinterpret<Vector>(gathered_pairs<size, count>(table, places));
    }
#endif
    constexpr auto objects = std::make_index_sequence<sizeof(Vector) / sizeof(Bool)>();
    return chosen<Vector>(table, places, count, objects);
}

}  // namespace many_bools

// The places of as many objects as a register holds, where they are equal or follow each other.
struct PlaceLine {
    enum class Form : std::uint8_t { Other, Equal, Consecutive };
    Form form;
    std::int32_t first;  // of the places
};

namespace many_bools {

template <class Places>
constexpr PlaceLine line_of(const Places& places, std::size_t begin, std::size_t end) {
    const std::int64_t first = rddl::detail::element_at(places, begin);
    bool are_equal = true, are_consecutive = true;
    for (std::size_t i = begin; i < end; ++i) {
        const std::int64_t place = rddl::detail::element_at(places, i);
        are_equal &= place == first;
        are_consecutive &= place == first + static_cast<std::int64_t>(i - begin);
    }
    const PlaceLine::Form form = are_equal         ? PlaceLine::Form::Equal
                                 : are_consecutive ? PlaceLine::Form::Consecutive
                                                   : PlaceLine::Form::Other;
    return {form, static_cast<std::int32_t>(first)};
}

}  // namespace many_bools

// Compilers take time to find the lines of more.
inline constexpr std::int64_t most_places_in_lines = 4096;

// The lines of a table of places, for registers of `width` objects.
template <const auto& places, int width>
inline constexpr auto lines_of_places = [] {
    constexpr auto count =
        static_cast<std::size_t>(detail::element_count<std::remove_cvref_t<decltype(places)>>);
    std::array<PlaceLine, (count + width - 1) / width> lines{};
    for (std::size_t k = 0; k < lines.size(); ++k) {
        const std::size_t end = (k + 1) * width;
        lines[k] = many_bools::line_of(places, k * width, end < count ? end : count);
    }
    return lines;
}();

// The same of packs, whose places may be lines.
template <int n, std::int64_t size, int lanes, class Place>
RDDL_INLINE ManyBools<Mask<lanes>, n> choose_many(const Mask<lanes>* table, const Place* places,
                                                  const PlaceLine* lines) {
    using Many = ManyBools<Mask<lanes>, n>;
    using Vector = typename Many::Vector;
    return Many::of_parts([&]<int p, int count>() RDDL_INLINE_LAMBDA {
        constexpr int bytes = count * static_cast<int>(sizeof(Mask<lanes>));
        const Mask<lanes>* const first = table + lines[p].first;
        if (lines[p].form == PlaceLine::Form::Consecutive)
            return simd::load_bytes<Vector, bytes>(first);
        if (lines[p].form == PlaceLine::Form::Equal) return first->bits - Vector{};
        return many_bools::gathered<Vector, size, count>(table, places + p * Many::part_width);
    });
}

#if defined(__AVX2__) && !defined(__AVX512VBMI__)
// Places that the compiler knows, of the objects of one register after the other: for each part of
// 16 bytes of a table, where those in it are; 0x80 for the others, for which a permutation gives
// zero.
template <const auto& places, std::int64_t size>
struct PlacesByPart {
    static constexpr auto count = static_cast<std::size_t>(
        rddl::detail::element_count<std::remove_cvref_t<decltype(places)>>);
    static constexpr std::size_t part_count = (size + 15) / 16, width = simd::register_bytes;
    struct alignas(width) Part {
        std::array<std::uint8_t, width> of;
        bool has_some;
    };
    static constexpr auto of_objects = [] {
        std::array<std::array<Part, part_count>, (count + width - 1) / width> all{};
        for (auto& parts : all)
            for (Part& part : parts) part.of.fill(0x80);
        for (std::size_t i = 0; i < count; ++i) {
            const auto place = static_cast<std::size_t>(rddl::detail::element_at(places, i));
            Part& part = all[i / width][place / 16];
            part.of[i % width] = static_cast<std::uint8_t>(place % 16);
            part.has_some = true;
        }
        return all;
    }();
};
// The bytes that have these places among 16.
RDDL_ALWAYS_INLINE auto permuted(__m128i some, const void* places) {
#ifdef RDDL_SIMD_AVX512
    return _mm512_maskz_shuffle_epi8(~std::uint64_t{0}, _mm512_maskz_broadcast_i32x4(0xFFFF, some),
                                     _mm512_load_si512(places));
#else
    return _mm256_shuffle_epi8(_mm256_broadcastsi128_si256(some),
                               _mm256_load_si256(static_cast<const __m256i*>(places)));
#endif
}
template <const auto& places, std::int64_t size, int n>
RDDL_INLINE ManyBools<bool, n> choose_many_by_parts(const bool* table) {
    using Many = ManyBools<bool, n>;
    using Places = PlacesByPart<places, size>;
    using Vector = typename Many::Vector;
    return Many::of_parts([&]<int p, int>() RDDL_INLINE_LAMBDA {
        Vector chosen{};
        const auto add = [&]<std::size_t i>() RDDL_INLINE_LAMBDA {
            constexpr auto& part = Places::of_objects[p][i];
            if constexpr (part.has_some) {
                constexpr int rest = static_cast<int>(size) - static_cast<int>(16 * i);
                const __m128i some = simd::load_parts(table + 16 * i, rest < 16 ? rest : 16);
                chosen |= simd::reinterpret<Vector>(permuted(some, part.of.data()));
            }
        };
        [&]<std::size_t... i>(std::index_sequence<i...>) RDDL_INLINE_LAMBDA {
            (add.template operator()<i>(), ...);
        }
        (std::make_index_sequence<Places::part_count>());
        return chosen;
    });
}
inline constexpr bool chooses_by_parts = true;
#else
inline constexpr bool chooses_by_parts = false;
template <const auto& places, std::int64_t size, int n>
ManyBools<bool, n> choose_many_by_parts(const bool* table) = delete;
#endif

// The elements of a table of `size` that have these places.
template <int n, std::int64_t size, class Bool, class Place>
RDDL_INLINE ManyBools<Bool, n> choose_many(const Bool* table, const Place* places) {
    using Many = ManyBools<Bool, n>;
    using Vector = typename Many::Vector;
    return Many::of_parts([&]<int p, int count>() RDDL_INLINE_LAMBDA {
        const Place* const first = places + p * Many::part_width;
#ifdef __AVX2__
        if constexpr (sizeof(Vector) == 16 && sizeof(Bool) == 1 && sizeof(Place) == 1)
            return simd::reinterpret<Vector>(simd::few_chosen_bytes<size>(
                table,
                simd::reinterpret<__m128i>(simd::load_constant_bytes<Vector, count>(first))));
        else
#endif
            if constexpr (sizeof(Bool) == 1 && sizeof(Place) == 1 &&
                          size <= simd::most_chosen_bytes)
            return simd::chosen_bytes<size>(table, simd::load_constant_bytes<Vector, count>(first));
        else
            return many_bools::chosen<Vector>(table, first, count,
                                              std::make_index_sequence<Many::part_width>());
    });
}

}  // namespace rddl::inline RDDL_SIMD_LEVEL
