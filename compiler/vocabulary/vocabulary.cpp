// Roles, aggregations, and what concerns whole matrices and vectors.
#include "vocabulary/vocabulary.hpp"

#include <array>
#include <cstddef>

namespace rddlc {
namespace {

constexpr std::array role_names = {
    std::string_view{"non-fluent"},     std::string_view{"state-fluent"},
    std::string_view{"action-fluent"},  std::string_view{"interm-fluent"},
    std::string_view{"derived-fluent"}, std::string_view{"observ-fluent"},
};

struct ReductionRow {
    Reduction reduction;
    std::string_view name;
};

constexpr ReductionRow reductions[] = {
    {Reduction::Sum, "sum"},       {Reduction::Product, "prod"},  {Reduction::Average, "avg"},
    {Reduction::Minimum, "min"},   {Reduction::Maximum, "max"},   {Reduction::ForAll, "forall"},
    {Reduction::Exists, "exists"}, {Reduction::ArgMin, "argmin"}, {Reduction::ArgMax, "argmax"},
};

// A row is found by the enumerator's number, so the orders have to agree.
consteval bool in_order() {
    for (std::size_t i = 0; i < std::size(reductions); ++i)
        if (reductions[i].reduction != static_cast<Reduction>(i)) return false;
    return true;
}
static_assert(in_order());

}  // namespace

std::string_view name_of(Role role) {
    return role_names[static_cast<std::size_t>(role)];
}
std::string_view name_of(Reduction reduction) {
    return reductions[static_cast<std::size_t>(reduction)].name;
}
std::string_view name_of(MatrixOperator op) {
    constexpr std::string_view names[] = {"det", "inverse", "pinverse", "cholesky"};
    return names[static_cast<std::size_t>(op)];
}
std::string_view name_of(VectorDistribution distribution) {
    constexpr std::string_view names[] = {"MultivariateNormal", "MultivariateStudent", "Dirichlet",
                                          "Multinomial"};
    return names[static_cast<std::size_t>(distribution)];
}

std::optional<Role> role_named(std::string_view name) {
    for (std::size_t i = 0; i < role_names.size(); ++i)
        if (role_names[i] == name) return static_cast<Role>(i);
    return std::nullopt;
}

std::optional<Reduction> reduction_named(std::string_view name) {
    for (const ReductionRow& candidate : reductions)
        if (candidate.name == name) return candidate.reduction;
    return std::nullopt;
}

std::vector<std::string> reduction_names() {
    std::vector<std::string> names;
    for (const ReductionRow& candidate : reductions) names.emplace_back(candidate.name);
    return names;
}

}  // namespace rddlc
