// Faults in words.
#pragma once

#include <rddl/context.hpp>
#include <rddl/sites.hpp>

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace rddl {

// What the parameter at fault should have been.
constexpr std::string_view requirement_of(FaultKind kind) {
    switch (kind) {
        case FaultKind::None:
            return "nothing is wrong";
        case FaultKind::Type:
            return "value has the wrong type";
        case FaultKind::NegativeExponent:
            return "exponent must not be negative for int operands";
        case FaultKind::GammaArgument:
            return "argument must be positive";
        case FaultKind::Probability:
            return "probability must be in [0, 1]";
        case FaultKind::PositiveProbability:
            return "probability must be in (0, 1]";
        case FaultKind::Width:
            return "upper bound minus lower bound must be finite and not negative";
        case FaultKind::Variance:
            return "variance must not be negative";
        case FaultKind::Rate:
            return "rate must be in [0, 9.2e18]";
        case FaultKind::Mean:
            return "mean must be positive";
        case FaultKind::Shape:
            return "shape must be positive";
        case FaultKind::Scale:
            return "scale must be positive";
        case FaultKind::DegreesOfFreedom:
            return "degrees of freedom must be positive";
        case FaultKind::Trials:
            return "number of trials must not be negative";
        case FaultKind::Successes:
            return "number of successes must be positive";
        case FaultKind::Weight:
            return "weights must not be negative";
        case FaultKind::ProbabilitySum:
            return "probabilities must sum to 1";
        case FaultKind::WeightSum:
            return "weights must have a positive, finite sum";
        case FaultKind::CountTooLarge:
            return "expected count must be at most 9.2e18";
        case FaultKind::PositiveWeight:
            return "weights must be positive";
        case FaultKind::Covariance:
            return "covariance must be positive definite";
        case FaultKind::Undefined:
            return "value is undefined";
        case FaultKind::ActionLimit:
            return "number of actions that are not the default must not exceed max-nondef-actions";
    }
    return "value is wrong";
}

// Text into a buffer of fixed size, cut off where the buffer ends, always terminated.
class FixedText {
  public:
    explicit FixedText(std::span<char> buffer) : buffer_(buffer) { buffer_[0] = '\0'; }

    FixedText& operator<<(std::string_view text) {
        for (const char character : text) {
            if (length_ + 1 == buffer_.size()) break;
            buffer_[length_++] = character;
        }
        buffer_[length_] = '\0';
        return *this;
    }
    FixedText& operator<<(std::int64_t value) { return write_number(value); }
    // In the shortest exact form; a nan, whose sign means nothing, without it.
    FixedText& operator<<(double value) {
        return value != value ? *this << std::string_view("nan") : write_number(value);
    }

  private:
    FixedText& write_number(auto value) {
        char digits[32];
        const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
        return *this << std::string_view(digits, static_cast<std::size_t>(end - digits));
    }

    std::span<char> buffer_;
    std::size_t length_ = 0;
};

namespace detail {

constexpr bool has_value(FaultKind kind) {
    return kind != FaultKind::Type && kind != FaultKind::Covariance && kind != FaultKind::Undefined;
}

// " (at ?c = c3, ?d = d1)"
inline void describe_objects(FixedText& text, const Site& site, std::int64_t index) {
    if (site.scope.empty()) return;
    std::int64_t stride = 1;
    for (const SiteVariable& variable : site.scope) stride *= variable.type->object_count;
    std::string_view separator = " (at ?";
    for (const SiteVariable& variable : site.scope) {
        stride /= variable.type->object_count;
        const std::int64_t object = index / stride % variable.type->object_count;
        text << separator << variable.name << " = " << variable.type->objects[object];
        separator = ", ?";
    }
    text << ")";
}

}  // namespace detail

// "domain.rddl:41:18: Bernoulli's probability must be in [0, 1], found 1.3 (at ?c = c3)"
inline void describe_fault(const FaultRecord& fault, const Site& site, std::span<char> buffer) {
    FixedText text(buffer);
    text << site.source.file << ":" << std::int64_t{site.source.line} << ":"
         << std::int64_t{site.source.column} << ": " << site.what;
    if (fault.kind != FaultKind::Type && fault.kind != FaultKind::Undefined)
        text << "'s " << requirement_of(fault.kind);
    if (detail::has_value(fault.kind)) text << ", found " << fault.value;
    detail::describe_objects(text, site, fault.place.index);
}

}  // namespace rddl
