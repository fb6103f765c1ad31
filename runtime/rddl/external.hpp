// External functions of RDDL, $f[...](...), in C++: how emitted code calls them, and how a shared
// object exports them to the interpreter. See docs/external-functions.md.
//
//     namespace rddl_extern {
//     inline double inflow(double level, std::span<const double, 3> rain) { ... }
//     }
//
// A value is passed by value: bool, std::int64_t or double. A table of one axis is a span of its
// elements, one of more axes is a span of its rows, which are std::arrays. A function that captures
// no variables returns its value; one that does is void and fills a span, its last parameter.
#pragma once

#include <rddl/export.h>
#include <rddl/external.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

// The namespace in which users define their functions.
namespace rddl_extern {}

// The function of that name as an object: all its overloads, or a template.
#define RDDL_EXTERN_FUNCTION(name)                                   \
    [](auto... values) -> decltype(::rddl_extern::name(values...)) { \
        return ::rddl_extern::name(values...);                       \
    }

// Exports a function from a shared object, with the signatures under which it is called:
//
//     RDDL_EXTERN(inflow, double(double, std::span<const double>))
#define RDDL_EXTERN(name, ...)                                                                  \
    extern "C" RDDL_EXPORT std::int32_t rddl_extern_##name(                                     \
        const rddl_array* arguments, std::int32_t count, const rddl_array* result) {            \
        return rddl::external::call<__VA_ARGS__>(                                               \
            RDDL_EXTERN_FUNCTION(name), {arguments, static_cast<std::size_t>(count)}, *result); \
    }

namespace rddl::external {

// A table of a record or of the instance as the function gets it.
template <class Row, std::size_t n>
constexpr std::span<const Row, n> input(const std::array<Row, n>& table) {
    return table;
}
template <class Row, std::size_t n>
constexpr std::span<Row, n> output(std::array<Row, n>& table) {
    return table;
}

namespace detail {

// Converts to T and to nothing else: finds parameters that would lose digits.
template <class T>
struct Exactly {
    template <class U>
    requires std::same_as<U, T>
    constexpr operator U() const { return {}; }
};

template <class T>
struct Strict {
    using type = std::conditional_t<std::is_arithmetic_v<T>, Exactly<T>, T>;
};

template <class T>
struct Plain {
    using type = T;
};
template <class T>
struct Plain<Exactly<T>> {
    using type = T;
};

// bool -> int -> real, as in RDDL; a span is filled, so nothing needs to be given.
template <class Given, class Result>
constexpr bool gives() {
    using Value = std::remove_cvref_t<typename Plain<Given>::type>;
    if (std::is_void_v<Result>) return true;
    if (std::is_same_v<Result, bool>) return std::is_same_v<Value, bool>;
    if (std::is_same_v<Result, std::int64_t>) return std::is_integral_v<Value>;
    return std::is_arithmetic_v<Value>;
}

template <class T>
constexpr rddl_scalar scalar_of() {
    static_assert(
        std::is_same_v<T, bool> || std::is_same_v<T, std::int64_t> || std::is_same_v<T, double>,
        "external functions work on bool, std::int64_t and double");
    if (std::is_same_v<T, bool>) return RDDL_BOOL;
    return std::is_same_v<T, std::int64_t> ? RDDL_INT : RDDL_REAL;
}

// Whether an array, from one of its axes on, is laid out as T.
template <class T>
struct Layout {
    static bool fits(const rddl_array& array, std::int32_t axis) {
        return array.rank == axis && array.scalar == scalar_of<T>();
    }
    static T of(const rddl_array& array) { return *static_cast<const T*>(array.data); }
};
template <class Row, std::size_t n>
struct Layout<std::array<Row, n>> {
    static bool fits(const rddl_array& array, std::int32_t axis) {
        return axis < array.rank && array.shape[axis] == static_cast<std::int64_t>(n) &&
               Layout<Row>::fits(array, axis + 1);
    }
};
template <class Row, std::size_t n>
struct Layout<std::span<Row, n>> {
    static bool fits(const rddl_array& array, std::int32_t axis) {
        if (axis >= array.rank) return false;
        const bool any_size = n == std::dynamic_extent;
        return (any_size || array.shape[axis] == static_cast<std::int64_t>(n)) &&
               Layout<std::remove_const_t<Row>>::fits(array, axis + 1);
    }
    static std::span<Row, n> of(const rddl_array& array) {
        return std::span<Row, n>(static_cast<Row*>(array.data),
                                 static_cast<std::size_t>(array.shape[0]));
    }
};

template <class Signature>
struct Call;

template <class Result, class... Arguments>
struct Call<Result(Arguments...)> {
    template <class Function>
    static constexpr bool is_possible() {
        using Strictly = std::tuple<typename Strict<Arguments>::type...>;
        if constexpr (!std::is_invocable_v<Function, Arguments...>) {
            return false;
        } else {
            return is_exact<Function>(static_cast<Strictly*>(nullptr));
        }
    }

    template <class Function>
    static bool attempt(Function function, std::span<const rddl_array> arguments,
                        const rddl_array& result) {
        return attempt(function, arguments, result, std::index_sequence_for<Arguments...>());
    }

  private:
    template <class Function, class... Strictly>
    static constexpr bool is_exact(std::tuple<Strictly...>*) {
        if constexpr (!std::is_invocable_v<Function, Strictly...>) {
            return false;
        } else {
            return gives<std::invoke_result_t<Function, Strictly...>, Result>();
        }
    }

    // The result is the last parameter of what gives no value.
    template <class Function, std::size_t... i>
    static bool attempt(Function function, std::span<const rddl_array> arguments,
                        const rddl_array& result, std::index_sequence<i...>) {
        constexpr std::size_t inputs = sizeof...(i) - (std::is_void_v<Result> ? 1 : 0);
        if (arguments.size() != inputs) return false;
        const auto array = [&](std::size_t k) -> const rddl_array& {
            return k < inputs ? arguments[k] : result;
        };
        if (!(Layout<Arguments>::fits(array(i), 0) && ...)) return false;
        if constexpr (std::is_void_v<Result>) {
            if (result.data) function(Layout<Arguments>::of(array(i))...);
        } else {
            if (!Layout<Result>::fits(result, 0)) return false;
            if (result.data)
                *static_cast<Result*>(result.data) = function(Layout<Arguments>::of(array(i))...);
        }
        return true;
    }
};

}  // namespace detail

// Can the function be called so, with no digits lost?
template <class Signature, class Function>
constexpr bool fits(Function) {
    return detail::Call<Signature>::template is_possible<Function>();
}

// Calls by the first signature that the arrays have; returns 0 if no signature fits.
template <class... Signatures, class Function>
std::int32_t call(Function function, std::span<const rddl_array> arguments,
                  const rddl_array& result) {
    static_assert((fits<Signatures>(Function()) && ...),
                  "the function of namespace rddl_extern cannot be called with this signature");
    return (detail::Call<Signatures>::attempt(function, arguments, result) || ...);
}

}  // namespace rddl::external
