// The distributions with plain parameters, and all that is particular to each. Laws, methods and
// sources: docs/distributions.md.
#include "support/failure.hpp"
#include "vocabulary/kernels.hpp"
#include "vocabulary/range.hpp"

#include <rddl/random/distributions.hpp>
#include <rddl/random/distributions/probability.hpp>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace rddlc {
namespace {

// Where a parameter may lie.
enum class Domain : std::uint8_t {
    Any,
    Positive,
    NotNegative,
    Probability,
    PositiveProbability,
    Limited,  // which limits there are is known to the runtime alone
};

struct Parameter {
    std::string_view name;  // empty: there is none
    Domain domain = Domain::Any;
    Drawn type = Drawn::Real;
};

struct DistributionRow {
    Distribution distribution;
    std::string_view name;
    std::array<Parameter, 2> parameters;
    Drawn drawn;
    // The kernel for the type of the draw; see draw_int() for draws that have neither.
    std::int64_t (*draw_int)(const Operands<double>&) = nullptr;
    double (*draw_real)(const Operands<double>&) = nullptr;
    RangeRule range = nullptr;                            // of real draws; null: unknown
    bool (*is_valid)(Range first, Range last) = nullptr;  // what parameters must fulfil together
    bool (*is_certain)(double first, double last) = nullptr;  // null: never
    bool by_inversion = false;
    bool extension = false;
};

using Reals = Operands<double>;
namespace sample = rddl::sample;

constexpr double longest_tail = 40;  // of an exponential or normal draw, in its scale

std::optional<Range> first_of(Range first, Range) {
    return first;
}
std::optional<Range> zero_to_one(Range, Range) {
    return Range{0, 1};
}
std::optional<Range> exponential_tails(Range location, Range scale) {
    return symmetric(magnitude(location) + longest_tail * magnitude(scale));
}

// clang-format off
// In the order of the enumeration.
constexpr DistributionRow distributions[] = {
    {.distribution = Distribution::KronDelta, .name = "KronDelta", .parameters = {{{"value"}}},
     .drawn = Drawn::AsGiven, .range = first_of},
    {.distribution = Distribution::DiracDelta, .name = "DiracDelta", .parameters = {{{"value"}}},
     .drawn = Drawn::AsGiven, .range = first_of},
    {.distribution = Distribution::Bernoulli, .name = "Bernoulli",
     .parameters = {{{"probability", Domain::Probability}}},
     .drawn = Drawn::Bool, .by_inversion = true},
    {.distribution = Distribution::Uniform, .name = "Uniform", .parameters = {{{"lower"}, {"upper"}}},
     .drawn = Drawn::Real,
     .draw_real = [](const Reals& x) { return sample::uniform(x.context, x.place, x.a, x.b); },
     .range = [](Range lower, Range upper) { return std::optional(padded(join(lower, upper))); },
     .is_valid = [](Range lower, Range upper) {
         return lower.upper <= upper.lower && std::isfinite(upper.upper - lower.lower);
     },
     .is_certain = [](double lower, double upper) { return lower == upper; }, .by_inversion = true},
    {.distribution = Distribution::Normal, .name = "Normal",
     .parameters = {{{"mean"}, {"variance", Domain::NotNegative}}},
     .drawn = Drawn::Real,
     .draw_real = [](const Reals& x) { return sample::normal(x.context, x.place, x.a, x.b); },
     .range = [](Range mean, Range variance) {
         return exponential_tails(mean, symmetric(std::sqrt(magnitude(variance))));
     },
     .is_certain = [](double, double variance) { return variance == 0; }, .by_inversion = true},
    {.distribution = Distribution::Poisson, .name = "Poisson", .parameters = {{{"rate", Domain::Limited}}},
     .drawn = Drawn::Int,
     .draw_int = [](const Reals& x) { return sample::poisson(x.context, x.place, x.a); },
     .is_certain = [](double rate, double) { return rate == 0; }},
    {.distribution = Distribution::Exponential, .name = "Exponential",
     .parameters = {{{"mean", Domain::Positive}}},
     .drawn = Drawn::Real,
     .draw_real = [](const Reals& x) { return sample::exponential(x.context, x.place, x.a); },
     .range = [](Range mean, Range) { return std::optional(symmetric(longest_tail * magnitude(mean))); },
     .by_inversion = true},
    {.distribution = Distribution::Weibull, .name = "Weibull",
     .parameters = {{{"shape", Domain::Positive}, {"scale", Domain::Positive}}},
     .drawn = Drawn::Real,
     .draw_real = [](const Reals& x) { return sample::weibull(x.context, x.place, x.a, x.b); },
     .range = [](Range shape, Range scale) -> std::optional<Range> {
         if (shape.lower <= 0) return std::nullopt;
         return symmetric(std::pow(longest_tail, 1 / shape.lower) * magnitude(scale));
     }, .by_inversion = true},
    {.distribution = Distribution::Gamma, .name = "Gamma",
     .parameters = {{{"shape", Domain::Positive}, {"scale", Domain::Positive}}},
     .drawn = Drawn::Real,
     .draw_real = [](const Reals& x) { return sample::gamma(x.context, x.place, x.a, x.b); },
     // A normal draw of the method makes it at most 103 times as large.
     .range = [](Range shape, Range scale) {
         return std::optional(symmetric(200 * (magnitude(shape) + 1) * magnitude(scale)));
     }},
    {.distribution = Distribution::Binomial, .name = "Binomial",
     .parameters = {{{"trials", Domain::Limited, Drawn::Int}, {"probability", Domain::Probability}}},
     .drawn = Drawn::Int},
    {.distribution = Distribution::NegativeBinomial, .name = "NegativeBinomial",
     .parameters = {{{"successes", Domain::Limited}, {"probability", Domain::PositiveProbability}}},
     .drawn = Drawn::Int,
     .draw_int = [](const Reals& x) { return sample::negative_binomial(x.context, x.place, x.a, x.b); },
     .is_certain = [](double, double probability) { return probability >= 1; }},
    {.distribution = Distribution::Beta, .name = "Beta",
     .parameters = {{{"a", Domain::Positive}, {"b", Domain::Positive}}},
     .drawn = Drawn::Real,
     .draw_real = [](const Reals& x) { return sample::beta(x.context, x.place, x.a, x.b); },
     .range = zero_to_one},
    {.distribution = Distribution::Geometric, .name = "Geometric",
     .parameters = {{{"probability", Domain::PositiveProbability}}},
     .drawn = Drawn::Int,
     .draw_int = [](const Reals& x) { return sample::geometric(x.context, x.place, x.a); },
     .is_certain = [](double probability, double) { return probability >= 1; }, .by_inversion = true},
    {.distribution = Distribution::Pareto, .name = "Pareto",
     .parameters = {{{"shape", Domain::Positive}, {"scale", Domain::Positive}}},
     .drawn = Drawn::Real,
     .draw_real = [](const Reals& x) { return sample::pareto(x.context, x.place, x.a, x.b); },
     .range = [](Range shape, Range scale) -> std::optional<Range> {
         if (shape.lower <= 0) return std::nullopt;
         return symmetric(std::exp(longest_tail / shape.lower) * magnitude(scale));
     }, .by_inversion = true},
    // A quotient by what may be next to 0, so that no range is known.
    {.distribution = Distribution::Student, .name = "Student",
     .parameters = {{{"degrees", Domain::Positive}}},
     .drawn = Drawn::Real,
     .draw_real = [](const Reals& x) { return sample::student(x.context, x.place, x.a); }},
    {.distribution = Distribution::Gumbel, .name = "Gumbel",
     .parameters = {{{"location"}, {"scale", Domain::Positive}}},
     .drawn = Drawn::Real,
     .draw_real = [](const Reals& x) { return sample::gumbel(x.context, x.place, x.a, x.b); },
     .range = exponential_tails, .by_inversion = true},
    {.distribution = Distribution::Laplace, .name = "Laplace",
     .parameters = {{{"location"}, {"scale", Domain::Positive}}},
     .drawn = Drawn::Real,
     .draw_real = [](const Reals& x) { return sample::laplace(x.context, x.place, x.a, x.b); },
     .range = exponential_tails, .by_inversion = true},
    {.distribution = Distribution::Cauchy, .name = "Cauchy",
     .parameters = {{{"location"}, {"scale", Domain::Positive}}},
     .drawn = Drawn::Real,
     .draw_real = [](const Reals& x) { return sample::cauchy(x.context, x.place, x.a, x.b); },
     // A tangent.
     .range = [](Range location, Range scale) {
         return std::optional(symmetric(magnitude(location) + 1e20 * magnitude(scale)));
     }, .by_inversion = true},
    {.distribution = Distribution::Gompertz, .name = "Gompertz",
     .parameters = {{{"shape", Domain::Positive}, {"rate", Domain::Positive}}},
     .drawn = Drawn::Real,
     .draw_real = [](const Reals& x) { return sample::gompertz(x.context, x.place, x.a, x.b); },
     .range = [](Range shape, Range rate) -> std::optional<Range> {
         if (shape.lower <= 0 || rate.lower <= 0) return std::nullopt;
         return symmetric((longest_tail / shape.lower + 1) * (longest_tail / rate.lower + 1));
     }, .by_inversion = true},
    {.distribution = Distribution::ChiSquare, .name = "ChiSquare",
     .parameters = {{{"degrees", Domain::Positive}}},
     .drawn = Drawn::Real,
     .draw_real = [](const Reals& x) { return sample::chi_square(x.context, x.place, x.a); },
     // Gamma(degrees / 2, 2).
     .range = [](Range degrees, Range) { return std::optional(symmetric(200 * (magnitude(degrees) + 2))); }},
    {.distribution = Distribution::Kumaraswamy, .name = "Kumaraswamy",
     .parameters = {{{"a", Domain::Positive}, {"b", Domain::Positive}}},
     .drawn = Drawn::Real,
     .draw_real = [](const Reals& x) { return sample::kumaraswamy(x.context, x.place, x.a, x.b); },
     .range = zero_to_one, .by_inversion = true},
};
// clang-format on

// Drawn by rddl::sample's functions directly (kernels.hpp).
constexpr bool is_drawn_apart(Distribution distribution) {
    return distribution == Distribution::Bernoulli || distribution == Distribution::Binomial;
}

// So that no kernel is missing when a program runs.
consteval bool has_kernel(const DistributionRow& row) {
    if (is_drawn_apart(row.distribution)) return true;
    switch (row.drawn) {
        case Drawn::AsGiven:
            return true;
        case Drawn::Int:
            return row.draw_int;
        case Drawn::Real:
            return row.draw_real;
        case Drawn::Bool:
            return false;
    }
    return false;
}

// A row is found by the enumerator's number, so the orders have to agree.
consteval bool has_all_kernels() {
    for (std::size_t i = 0; i < std::size(distributions); ++i) {
        const DistributionRow& row = distributions[i];
        if (row.distribution != static_cast<Distribution>(i) || !has_kernel(row)) return false;
        if (row.extension && row.drawn == Drawn::AsGiven) return false;
    }
    return true;
}
static_assert(has_all_kernels());

const DistributionRow& row(Distribution distribution) {
    if (static_cast<std::size_t>(distribution) >= std::size(distributions))
        own_mistake("a distribution without a row");
    return distributions[static_cast<std::size_t>(distribution)];
}

bool is_probability(Range range) {
    return rddl::is_probability<rddl::Scalar>(range.lower) &&
           rddl::is_probability<rddl::Scalar>(range.upper);
}

bool always_in(Domain domain, Range range) {
    switch (domain) {
        case Domain::Any:
            return true;
        case Domain::Positive:
            return excludes_zero(range) && range.lower > 0;
        case Domain::NotNegative:
            return range.lower >= 0;
        case Domain::Probability:
            return is_probability(range);
        case Domain::PositiveProbability:
            return is_probability(range) && range.lower > 0;
        case Domain::Limited:
            return false;
    }
    return false;
}

}  // namespace

std::string_view name_of(Distribution distribution) {
    return row(distribution).name;
}
std::string form_of(Distribution distribution) {
    const auto& [first, last] = row(distribution).parameters;
    return fmt::format("{}({}{}{})", row(distribution).name, first.name,
                       last.name.empty() ? "" : ", ", last.name);
}

std::size_t arity_of(Distribution distribution) {
    return row(distribution).parameters.back().name.empty() ? 1 : 2;
}
bool takes_int(Distribution distribution, std::size_t parameter) {
    return row(distribution).parameters[parameter].type == Drawn::Int;
}
Drawn drawn_by(Distribution distribution) {
    return row(distribution).drawn;
}
bool is_delta(Distribution distribution) {
    return row(distribution).drawn == Drawn::AsGiven;
}
bool is_by_inversion(Distribution distribution) {
    return row(distribution).by_inversion;
}
bool is_extension(Distribution distribution) {
    return row(distribution).extension;
}

std::optional<Distribution> distribution_named(std::string_view name) {
    for (const DistributionRow& candidate : distributions)
        if (candidate.name == name) return candidate.distribution;
    return std::nullopt;
}

std::vector<std::string> distribution_names() {
    std::vector<std::string> names;
    for (const DistributionRow& candidate : distributions) names.emplace_back(candidate.name);
    return names;
}

std::int64_t draw_int(Distribution distribution, const Operands<double>& parameters) {
    return row(distribution).draw_int(parameters);
}
double draw_real(Distribution distribution, const Operands<double>& parameters) {
    return row(distribution).draw_real(parameters);
}

bool is_certain(Distribution distribution, double a, double b) {
    return row(distribution).is_certain && row(distribution).is_certain(a, b);
}

std::optional<Range> range_of(Distribution distribution,
                              std::span<const std::optional<Range>> parameters) {
    return apply(row(distribution).range, parameters);
}

bool always_in_domain(Distribution distribution, std::span<const std::optional<Range>> parameters) {
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        if (!parameters[i] || !is_finite(*parameters[i])) return false;
        if (!always_in(row(distribution).parameters[i].domain, *parameters[i])) return false;
    }
    const auto is_valid = row(distribution).is_valid;
    return !is_valid || is_valid(*parameters.front(), *parameters.back());
}

}  // namespace rddlc
