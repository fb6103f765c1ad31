// The derivative of each operator and each distribution.
#include "autodiff/evaluation.hpp"
#include "autodiff/instruction_value.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace rddlc::autodiff {

// The derivatives of an instruction's value by its operands a and b.
struct Evaluation::Partials {
    double a = 0, b = 0;
};

namespace {

// The derivative of ln(gamma(x)) for x > 0: recurrence, then the asymptotic series.
double digamma(double x) {
    double shift = 0;
    for (; x < 10; x += 1) shift -= 1 / x;
    const double y = 1 / (x * x);
    return shift + std::log(x) - 0.5 / x -
           y * (1.0 / 12 - y * (1.0 / 120 - y * (1.0 / 252 - y * (1.0 / 240 - y / 132))));
}

double sign(double x) {
    return x > 0 ? 1 : x < 0 ? -1 : 0;
}

template <class Partials>
Partials of_power(double base, double exponent, double value) {
    const double by_base = exponent == 0 ? 0 : exponent * std::pow(base, exponent - 1);
    return {by_base, base > 0 ? std::log(base) * value : 0};
}

// Of reals; `v` is the value.
template <class Partials>
Partials of_operator(Operator op, double a, double b, double v) {
    switch (op) {
        case Operator::Add:
            return {1, 1};
        case Operator::Subtract:
            return {1, -1};
        case Operator::Multiply:
            return {b, a};
        case Operator::Negate:
            return {-1};
        case Operator::Divide:
            return {1 / b, -v / b};
        case Operator::Abs:
            return {sign(a)};
        case Operator::Minimum:
            return b < a ? Partials{0, 1} : Partials{1, 0};
        case Operator::Maximum:
            return b > a ? Partials{0, 1} : Partials{1, 0};
        case Operator::FloorModuloReal:
            return {1, -std::floor(a / b)};
        case Operator::Power:
            return of_power<Partials>(a, b, v);
        case Operator::Exp:
            return {v};
        case Operator::Ln:
            return {1 / a};
        case Operator::Sqrt:
            return {0.5 / v};
        case Operator::Cos:
            return {-std::sin(a)};
        case Operator::Sin:
            return {std::cos(a)};
        case Operator::Tan:
            return {1 + v * v};
        case Operator::Acos:
            return {-1 / std::sqrt((1 - a) * (1 + a))};
        case Operator::Asin:
            return {1 / std::sqrt((1 - a) * (1 + a))};
        case Operator::Atan:
            return {1 / (1 + a * a)};
        case Operator::Cosh:
            return {std::sinh(a)};
        case Operator::Sinh:
            return {std::cosh(a)};
        case Operator::Tanh:
            return {(1 - v) * (1 + v)};
        case Operator::Log:
            return {1 / (a * std::log(b)), -v / (b * std::log(b))};
        case Operator::Hypot:
            return {a / v, b / v};
        case Operator::Atan2: {
            const double square = a * a + b * b;
            return {b / square, -a / square};
        }
        case Operator::LnGamma:
            return {digamma(a)};
        case Operator::Gamma:
            return {v * digamma(a)};
        case Operator::Defined:
            return {1};
        // Their values are bools or ints.
        case Operator::FloorDivide:
        case Operator::FloorModulo:
        case Operator::Equal:
        case Operator::NotEqual:
        case Operator::Less:
        case Operator::LessEqual:
        case Operator::Greater:
        case Operator::GreaterEqual:
        case Operator::And:
        case Operator::Or:
        case Operator::Not:
        case Operator::Implies:
        case Operator::Equivalent:
        case Operator::Sign:
        case Operator::Round:
        case Operator::Floor:
        case Operator::Ceil:
        case Operator::BitAnd:
        case Operator::BitOr:
        case Operator::BitXor:
        case Operator::CountOnes:
            break;
    }
    return {};
}

// Those that are polynomials, or nearly, have the derivative of reals. Division and powers have it
// only if ints are relaxed.
template <class Partials>
Partials of_int_operator(Operator op, double a, double b, double v, bool is_relaxed) {
    if (is_one_of(op, {Operator::FloorDivide, Operator::FloorModulo}) && is_relaxed && b != 0)
        return op == Operator::FloorDivide ? Partials{1 / b, -a / (b * b)}
                                           : Partials{1, -std::floor(a / b)};
    if (op == Operator::Power && !is_relaxed) return {};
    return of_operator<Partials>(op, a, b, v);
}

// Product logic: a ^ b is a * b.
template <class Partials>
Partials of_logic(Operator op, double a, double b) {
    if (op == Operator::And) return {b, a};
    if (op == Operator::Or) return {1 - b, 1 - a};
    if (op == Operator::Not) return {-1};
    if (op == Operator::Implies) return {b - 1, a};
    if (op == Operator::NotEqual) return {1 - 2 * b, 1 - 2 * a};
    return {2 * b - 1, 2 * a - 1};  // Equivalent, Equal
}

template <class Partials>
Partials of_comparison(Operator op, double a, double b, double sharpness) {
    const double z = sharpness * (a - b);
    double slope;
    if (is_one_of(op, {Operator::Equal, Operator::NotEqual})) {
        const double t = std::tanh(z);
        slope = (op == Operator::Equal ? -2 : 2) * t * (1 - t * t);
    } else {
        const double s = sigmoid(z);
        slope = s * (1 - s) * (is_one_of(op, {Operator::Less, Operator::LessEqual}) ? -1 : 1);
    }
    return {sharpness * slope, -sharpness * slope};
}

template <class Partials>
Partials of_rounding(Operator op, double a, double sharpness) {
    if (op != Operator::Sign) return {1};
    const double t = std::tanh(sharpness * a);
    return {sharpness * (1 - t * t)};
}

// Reparameterised: the derivative of the draw with the same random number (Kingma and Welling,
// 2014). The shape of Gamma, and the parameters of Beta, Student and ChiSquare, count as constants:
// their draws are not by inversion.
template <class Partials>
Partials of_real_draw(Distribution distribution, double a, double b, double v) {
    switch (distribution) {
        case Distribution::Uniform: {
            const double u = b > a ? (v - a) / (b - a) : 0.5;
            return {1 - u, u};
        }
        case Distribution::Normal:
            return {1, b > 0 ? (v - a) / (2 * b) : 0};
        case Distribution::Exponential:
            return {v / a};
        case Distribution::Weibull:
            return {-v * std::log(v / b) / a, v / b};
        case Distribution::Gamma:
            return {0, v / b};
        case Distribution::Pareto:  // Lomax's form
            return {-(v + b) * std::log1p(v / b) / a, v / b};
        case Distribution::Gumbel:
        case Distribution::Laplace:
        case Distribution::Cauchy:
            return {1, (v - a) / b};
        case Distribution::Gompertz: {
            // v = ln(1 + e / a) / b, with e of the standard exponential distribution.
            const double growth = std::exp(-b * v);
            return {-(1 - growth) / (a * b), -v / b};
        }
        case Distribution::Kumaraswamy: {
            // v^a = 1 - u^(1/b)
            const double power = std::pow(v, a);
            const double by_power = v / (a * power);
            return {-v * std::log(v) / a, by_power * (1 - power) * std::log1p(-power) / b};
        }
        case Distribution::Beta:
        case Distribution::Student:
        case Distribution::ChiSquare:
        case Distribution::KronDelta:
        case Distribution::DiracDelta:
        case Distribution::Bernoulli:
        case Distribution::Poisson:
        case Distribution::Binomial:
        case Distribution::NegativeBinomial:
        case Distribution::Geometric:
            break;
    }
    return {};
}

// Of the mean.
template <class Partials>
Partials of_int_draw(Distribution distribution, double a, double b) {
    if (distribution == Distribution::Poisson) return {1};
    if (distribution == Distribution::Geometric) return {-1 / (a * a)};
    if (distribution == Distribution::NegativeBinomial) return {(1 - b) / b, -a / (b * b)};
    return {};
}

}  // namespace

void Evaluation::clear_adjoints() {
    std::ranges::fill(adjoints_, Lane{});
}

void Evaluation::add_next_adjoint(std::size_t number, const Lane& adjoint) {
    for (std::size_t lane = 0; lane < lanes; ++lane)
        add(program_.next[number], lane, adjoint[lane]);
}

void Evaluation::add_reward_adjoint(const Lane& adjoint) {
    for (std::size_t lane = 0; lane < lanes; ++lane) add(program_.reward, lane, adjoint[lane]);
}

void Evaluation::backward() {
    for (std::size_t i = program_.instructions.size(); i-- > 0;)
        propagate(program_.instructions[i]);
}

void Evaluation::add(Slot slot, std::size_t lane, double adjoint) {
    adjoints_[slot][lane] += adjoint - adjoint == 0 ? adjoint : 0;
}

template <class Derivatives>
void Evaluation::add_partials(const Instruction& instruction, const Derivatives& derivatives) {
    const Lane& g = adjoints_[instruction.out];
    const Lane& v = values_[instruction.out];
    const bool is_binary = instruction.b != no_slot;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        if (g[lane] == 0) continue;
        const double a = values_[instruction.a][lane];
        const double b = is_binary ? values_[instruction.b][lane] : a;
        const Partials partials = derivatives(a, b, v[lane]);
        add(instruction.a, lane, g[lane] * partials.a);
        if (is_binary) add(instruction.b, lane, g[lane] * partials.b);
    }
}

void Evaluation::propagate(const Instruction& instruction) {
    const Lane& g = adjoints_[instruction.out];
    if (std::ranges::all_of(g, [](double each) { return each == 0; })) return;
    const bool is_relaxed = relaxation_.mode != Mode::Exact;
    const double sharpness = relaxation_.sharpness;
    const Operator op = instruction.op;
    switch (instruction.code) {
        case Code::RealOperator:
            // Each has a loop of its own, in which the operator is a constant.
            if (op == Operator::Add)
                return add_partials(instruction, [](double, double, double) {
                    return Partials{1, 1};
                });
            if (op == Operator::Multiply)
                return add_partials(instruction, [](double a, double b, double) {
                    return Partials{b, a};
                });
            return add_partials(instruction, [op](double a, double b, double v) {
                return of_operator<Partials>(op, a, b, v);
            });
        case Code::GuardedProduct:
            return add_partials(instruction, [](double a, double b, double) {
                return Partials{b, a};
            });
        case Code::IntOperator:
            return add_partials(instruction, [&](double a, double b, double v) {
                return of_int_operator<Partials>(op, a, b, v, is_relaxed);
            });
        case Code::ToInt:
            if (!is_relaxed) return;
            return add_partials(instruction, [&](double a, double, double) {
                return of_rounding<Partials>(op, a, sharpness);
            });
        case Code::Comparison:
            if (!is_relaxed) return;
            return add_partials(instruction, [&](double a, double b, double) {
                return of_comparison<Partials>(op, a, b, sharpness);
            });
        case Code::Logic:
            return add_partials(instruction, [&](double a, double b, double) {
                return of_logic<Partials>(op, a, b);
            });
        case Code::Bernoulli:
            if (!is_relaxed) return;
            return add_partials(instruction, [&](double p, double, double v) {
                if (relaxation_.mode == Mode::StraightThrough) return Partials{1};
                return Partials{v * (1 - v) / (relaxation_.temperature * p * (1 - p))};
            });
        case Code::DrawReal:
            return add_partials(instruction, [&](double a, double b, double v) {
                return of_real_draw<Partials>(instruction.distribution, a, b, v);
            });
        case Code::DrawInt:
            if (!is_relaxed) return;
            return add_partials(instruction, [&](double a, double b, double) {
                return of_int_draw<Partials>(instruction.distribution, a, b);
            });
        case Code::Binomial:
            if (!is_relaxed) return;
            return add_partials(instruction, [](double n, double p, double) {
                return Partials{p, n};
            });
        case Code::Select:
        case Code::Gather:
        case Code::Sum:
        case Code::IntSum:
        case Code::ForAll:
        case Code::Exists:
        case Code::Discrete:
            return propagate_others(instruction);
        case Code::ArgMin:  // these are constant almost everywhere
        case Code::ArgMax:
        case Code::Fault:
            return;
    }
}

void Evaluation::propagate_others(const Instruction& instruction) {
    const Lane& g = adjoints_[instruction.out];
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        if (g[lane] == 0) continue;
        const auto get = [&](Slot slot) {
            return values_[slot][lane];
        };
        if (instruction.code == Code::Select) {
            const double condition = get(instruction.a);
            add(instruction.a, lane, g[lane] * (get(instruction.b) - get(instruction.c)));
            if (condition != 0) add(instruction.b, lane, g[lane] * condition);
            if (condition != 1) add(instruction.c, lane, g[lane] * (1 - condition));
        } else if (instruction.code == Code::Gather) {
            add(InstructionValue(program_, instruction, get, contexts_[lane]).chosen(), lane,
                g[lane]);
        } else {
            propagate_list(instruction, lane);
        }
    }
}

void Evaluation::propagate_list(const Instruction& instruction, std::size_t lane) {
    const double g = adjoints_[instruction.out][lane];
    const std::span operands(program_.operands.data() + instruction.first, instruction.count);
    const auto value = [&](std::size_t i) {
        return values_[operands[i]][lane];
    };
    if (is_one_of(instruction.code, {Code::Sum, Code::IntSum})) {
        for (const Slot operand : operands) add(operand, lane, g);
    } else if (instruction.code == Code::ForAll) {
        add_products_of_others(operands, lane, g, value);
    } else if (instruction.code == Code::Exists) {
        add_products_of_others(operands, lane, g, [&](std::size_t i) { return 1 - value(i); });
    } else if (relaxation_.mode != Mode::Exact) {  // Discrete: the derivative of the mean index
        double total = 0, mean = 0;
        for (std::size_t i = 0; i < operands.size(); ++i) {
            total += value(i);
            mean += static_cast<double>(i) * value(i);
        }
        for (std::size_t i = 0; i < operands.size(); ++i)
            add(operands[i], lane, g * (static_cast<double>(i) - mean / total) / total);
    }
}

// The derivative of f(0) * f(1) * ... by each: the product of the others, from both ends.
template <class Factor>
void Evaluation::add_products_of_others(std::span<const Slot> operands, std::size_t lane, double g,
                                        const Factor& factor) {
    work_.resize(operands.size());
    double before = 1;
    for (std::size_t i = 0; i < operands.size(); ++i) {
        work_[i] = before;
        before *= factor(i);
    }
    double after = 1;
    for (std::size_t i = operands.size(); i-- > 0;) {
        add(operands[i], lane, g * work_[i] * after);
        after *= factor(i);
    }
}

}  // namespace rddlc::autodiff
