#include "ir/fold.hpp"

#include "support/match.hpp"
#include "vocabulary/kernels.hpp"

#include <rddl/values/reductions.hpp>

#include <limits>

namespace rddlc::ir {
namespace {

Value apply(Operator op, bool a, bool b, Context&) {
    return kernels_of(op).of_bools(a, b);
}

Value apply(Operator op, std::int64_t a, std::int64_t b, Context& context) {
    if (is_comparison(op)) return compare(op, a, b);
    return kernels_of(op).of_ints({a, b, {}, context});
}

Value apply(Operator op, double a, double b, Context& context) {
    if (is_comparison(op)) return compare(op, a, b);
    const OperatorKernels& kernels = kernels_of(op);
    if (kernels.to_int) return kernels.to_int(a);
    return kernels.of_reals({a, b, {}, context});
}

template <class T>
std::optional<Value> fold_numeric(Reduction op, std::int64_t size, T body) {
    const auto same = [&](rddl::Index) {
        return body;
    };
    switch (op) {
        case Reduction::Sum:
            return rddl::sum<T>(size, same);
        case Reduction::Product:
            return rddl::product<T>(size, same);
        case Reduction::Minimum:
        case Reduction::Maximum:
            return body;
        case Reduction::ArgMin:
        case Reduction::ArgMax:
            return std::int64_t{0};
        case Reduction::Average:
        case Reduction::ForAll:
        case Reduction::Exists:
            break;
    }
    return std::nullopt;
}

}  // namespace

std::int64_t count_at_most(const Table& sorted, const Value& value) {
    std::int64_t count = 0;
    for (std::int64_t length = sorted.size(); length > 0; length /= 2) {
        const std::int64_t half = (length + 1) / 2;
        if (sorted[count + half - 1] <= value) count += half;
    }
    return count;
}

Value convert(const Value& value, Scalar type) {
    return match(value, [&](auto v) -> Value {
        switch (type) {
            case Scalar::Bool:
                return v != 0;
            case Scalar::Int:
                return static_cast<std::int64_t>(v);
            case Scalar::Real:
                return static_cast<double>(v);
        }
        return v;
    });
}

Value as_in_a_step(const Value& value, RealType real) {
    const auto* number = std::get_if<double>(&value);
    if (!number || real != RealType::Float) return value;
    return static_cast<double>(static_cast<float>(*number));
}

std::optional<Value> fold(Operator op, std::span<const Value> operands) {
    Context context;
    const Value result = match(operands.front(), [&](auto a) {
        return apply(op, a, std::get<decltype(a)>(operands.back()), context);
    });
    if (context.fault) return std::nullopt;
    return result;
}

std::optional<Value> fold(Reduction op, std::int64_t size, const Value& body) {
    if (is_quantifier(op)) return body;
    return match(
        body, [](bool) { return std::optional<Value>(); },
        [&](auto value) { return fold_numeric(op, size, value); });
}

std::optional<Value> fold_empty(Reduction op, Scalar type) {
    switch (op) {
        case Reduction::Sum:
            return convert(Value(false), type);
        case Reduction::Product:
            return convert(Value(true), type);
        case Reduction::ForAll:
            return true;
        case Reduction::Exists:
            return false;
        case Reduction::Average:
        case Reduction::Minimum:
        case Reduction::Maximum:
        case Reduction::ArgMin:
        case Reduction::ArgMax:
            break;
    }
    return std::nullopt;
}

}  // namespace rddlc::ir
