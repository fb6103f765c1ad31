#include "ir/kernels.hpp"

#include <rddl/random/distributions.hpp>
#include <rddl/values/bits.hpp>
#include <rddl/values/linear_algebra.hpp>

#include <cstdlib>

namespace rddlc::ir {

void unreachable_operator() {
    std::abort();
}

bool apply_logic(Operator op, bool a, bool b) {
    switch (op) {
        case Operator::And:
            return a && b;
        case Operator::Or:
            return a || b;
        case Operator::Not:
            return !a;
        case Operator::Implies:
            return !a || b;
        case Operator::Equivalent:
        case Operator::Equal:
            return a == b;
        case Operator::NotEqual:
            return a != b;
        default:
            unreachable_operator();
    }
}

std::int64_t apply_int(Operator op, std::int64_t a, std::int64_t b, rddl::Place place,
                       Context& context) {
    switch (op) {
        case Operator::Add:
            return rddl::wrap_add(a, b);
        case Operator::Subtract:
            return rddl::wrap_sub(a, b);
        case Operator::Multiply:
            return rddl::wrap_mul(a, b);
        case Operator::Negate:
            return rddl::wrap_neg(a);
        case Operator::FloorDivide:
            return rddl::floor_div(a, b);
        case Operator::FloorModulo:
            return rddl::floor_mod(a, b);
        case Operator::Abs:
            return rddl::absolute(a);
        case Operator::Sign:
            return rddl::sign(a);
        case Operator::Minimum:
            return rddl::minimum(a, b);
        case Operator::Maximum:
            return rddl::maximum(a, b);
        case Operator::Power:
            return rddl::power(context, place, a, b);
        case Operator::BitAnd:
            return rddl::bit_and(a, b);
        case Operator::BitOr:
            return rddl::bit_or(a, b);
        case Operator::BitXor:
            return rddl::bit_xor(a, b);
        case Operator::CountOnes:
            return rddl::count_ones(a);
        default:
            unreachable_operator();
    }
}

std::int64_t apply_to_int(Operator op, double a) {
    switch (op) {
        case Operator::Sign:
            return rddl::sign(a);
        case Operator::Round:
            return rddl::round(a);
        case Operator::Floor:
            return rddl::floor(a);
        case Operator::Ceil:
            return rddl::ceil(a);
        default:
            unreachable_operator();
    }
}

double apply_real(Operator op, double a, double b, rddl::Place place, Context& context) {
    switch (op) {
        case Operator::Add:
            return a + b;
        case Operator::Subtract:
            return a - b;
        case Operator::Multiply:
            return a * b;
        case Operator::Negate:
            return -a;
        case Operator::Divide:
            return a / b;
        case Operator::Abs:
            return rddl::absolute(a);
        case Operator::Minimum:
            return rddl::minimum(a, b);
        case Operator::Maximum:
            return rddl::maximum(a, b);
        case Operator::FloorModuloReal:
            return rddl::floor_mod(a, b);
        case Operator::Power:
            return rddl::power(a, b);
        case Operator::Exp:
            return rddl::exp(a);
        case Operator::Ln:
            return rddl::ln(a);
        case Operator::Sqrt:
            return rddl::sqrt(a);
        case Operator::Cos:
            return rddl::cos(a);
        case Operator::Sin:
            return rddl::sin(a);
        case Operator::Tan:
            return rddl::tan(a);
        case Operator::Acos:
            return rddl::acos(a);
        case Operator::Asin:
            return rddl::asin(a);
        case Operator::Atan:
            return rddl::atan(a);
        case Operator::Cosh:
            return rddl::cosh(a);
        case Operator::Sinh:
            return rddl::sinh(a);
        case Operator::Tanh:
            return rddl::tanh(a);
        case Operator::Log:
            return rddl::log(a, b);
        case Operator::Hypot:
            return rddl::hypot(a, b);
        case Operator::Atan2:
            return rddl::atan2(a, b);
        case Operator::LnGamma:
            return rddl::ln_gamma(context, place, a);
        case Operator::Gamma:
            return rddl::gamma(context, place, a);
        case Operator::Defined:
            return rddl::defined(context, place, a);
        default:
            unreachable_operator();
    }
}

std::int64_t draw_int(Distribution distribution, double a, double b, rddl::Place place,
                      Context& context) {
    namespace sample = rddl::sample;
    switch (distribution) {
        case Distribution::Poisson:
            return sample::poisson(context, place, a);
        case Distribution::Geometric:
            return sample::geometric(context, place, a);
        case Distribution::NegativeBinomial:
            return sample::negative_binomial(context, place, a, b);
        default:
            unreachable_operator();
    }
}

double draw_real(Distribution distribution, double a, double b, rddl::Place place,
                 Context& context) {
    namespace sample = rddl::sample;
    switch (distribution) {
        case Distribution::Uniform:
            return sample::uniform(context, place, a, b);
        case Distribution::Normal:
            return sample::normal(context, place, a, b);
        case Distribution::Exponential:
            return sample::exponential(context, place, a);
        case Distribution::Weibull:
            return sample::weibull(context, place, a, b);
        case Distribution::Gamma:
            return sample::gamma(context, place, a, b);
        case Distribution::Beta:
            return sample::beta(context, place, a, b);
        case Distribution::Pareto:
            return sample::pareto(context, place, a, b);
        case Distribution::Student:
            return sample::student(context, place, a);
        case Distribution::Gumbel:
            return sample::gumbel(context, place, a, b);
        case Distribution::Laplace:
            return sample::laplace(context, place, a, b);
        case Distribution::Cauchy:
            return sample::cauchy(context, place, a, b);
        case Distribution::Gompertz:
            return sample::gompertz(context, place, a, b);
        case Distribution::ChiSquare:
            return sample::chi_square(context, place, a);
        case Distribution::Kumaraswamy:
            return sample::kumaraswamy(context, place, a, b);
        default:
            unreachable_operator();
    }
}

}  // namespace rddlc::ir
