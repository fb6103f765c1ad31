// Faults in words.
#pragma once

#include <rddl/interface/details.hpp>
#include <rddl/interface/fixed_text.hpp>
#include <rddl/interface/sites.hpp>
#include <rddl/values/context.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace rddl {

// The requirement that the parameter at fault violates.
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

namespace detail {

constexpr bool has_value(FaultKind kind) {
    return kind != FaultKind::Type && kind != FaultKind::Covariance && kind != FaultKind::Undefined;
}

// " (at ?c = c3, ?d = d1)"
inline void describe_objects(FixedText& text, std::span<const SiteVariable> scope,
                             std::int64_t index) {
    if (scope.empty()) return;
    std::int64_t stride = 1;
    for (const SiteVariable& variable : scope) stride *= variable.type->object_count;
    std::string_view separator = " (at ?";
    for (const SiteVariable& variable : scope) {
        stride /= variable.type->object_count;
        const std::int64_t object = index / stride % variable.type->object_count;
        text << separator << variable.name << " = " << variable.type->objects[object];
        separator = ", ?";
    }
    text << ")";
}

}  // namespace detail

// "domain.rddl:52:9: precondition violated: release(?r) <= rlevel(?r)"
inline void describe_violation(FixedText& text, const rddl_condition& condition) {
    text << condition.source.file << ":" << std::int64_t{condition.source.line} << ":"
         << std::int64_t{condition.source.column} << ": precondition violated: " << condition.text;
}

// The first objects for which a precondition does not hold.
inline void describe_culprits(FixedText& text, const ConditionPlaces& places,
                              const std::byte* record) {
    std::int64_t count = 1;
    for (const SiteVariable& variable : places.scope) count *= variable.type->object_count;
    const std::byte* const holds = record + places.offset;
    const std::byte* const first = std::find(holds, holds + count, std::byte{0});
    if (first != holds + count) detail::describe_objects(text, places.scope, first - holds);
}

// "domain.rddl:41:18: Bernoulli's probability must be in [0, 1], found 1.3 (at ?c = c3)"
inline void describe_fault(const FaultRecord& fault, const Site& site, std::span<char> buffer) {
    FixedText text(buffer);
    text << site.source.file << ":" << std::int64_t{site.source.line} << ":"
         << std::int64_t{site.source.column} << ": " << site.what;
    if (fault.kind != FaultKind::Type && fault.kind != FaultKind::Undefined)
        text << "'s " << requirement_of(fault.kind);
    if (detail::has_value(fault.kind)) text << ", found " << fault.value;
    detail::describe_objects(text, site.scope, fault.place.index);
}

}  // namespace rddl
