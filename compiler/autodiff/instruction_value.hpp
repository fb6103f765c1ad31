// The value of an instruction, in one lane.
#pragma once

#include "autodiff/evaluation.hpp"
#include "support/failure.hpp"
#include "support/sigmoid.hpp"

#include <rddl/random/distributions.hpp>
#include <rddl/values/ops.hpp>
#include <rddl/values/reductions.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace rddlc::autodiff {

// The context records faults. `get` gives the value of a slot.
template <class Get>
class InstructionValue {
  public:
    InstructionValue(const StraightLine& program, const Instruction& instruction, const Get& get,
                     Context& context)
        : program_(program), instruction_(instruction), get_(get), context_(context) {}

    // As the other engines compute it. Over 40 lines: a table of all codes.
    double exact() const {
        const Instruction& i = instruction_;
        switch (i.code) {
            case Code::RealOperator:
                return kernels_of(i.op).of_reals({a(), b(), place(), context_});
            case Code::IntOperator:
                return real(kernels_of(i.op).of_ints({whole(a()), whole(b()), place(), context_}));
            case Code::ToInt:
                return real(kernels_of(i.op).to_int(a()));
            case Code::Comparison:
                return truth(compare(i.op, a(), b()));
            case Code::Logic:
                return truth(kernels_of(i.op).of_bools(a() != 0, b() != 0));
            case Code::Select:
                return a() != 0 ? get_(i.b) : get_(i.c);
            case Code::GuardedProduct:
                return a() == 0 ? a() : a() * b();
            case Code::Sum:
            case Code::IntSum:
                return sum();
            case Code::ForAll:
                return truth(first_with(0.0) == i.count);
            case Code::Exists:
                return truth(first_with(1.0) < i.count);
            case Code::ArgMin:
                return real(rddl::arg_min<std::int64_t>(i.count, term()));
            case Code::ArgMax:
                return real(rddl::arg_max<std::int64_t>(i.count, term()));
            case Code::Gather:
                return get_(chosen());
            case Code::Bernoulli:
                return truth(rddl::sample::bernoulli(context_, place(), a()));
            case Code::DrawReal:
                return draw_real(i.distribution, {a(), b(), place(), context_});
            case Code::DrawInt:
                return real(draw_int(i.distribution, {a(), b(), place(), context_}));
            case Code::Binomial:
                return real(rddl::sample::binomial(context_, place(), whole(a()), b()));
            case Code::Discrete:
                return real(i.normalise
                                ? rddl::sample::unnormalised_discrete_over(context_, place(),
                                                                           i.count, term())
                                : rddl::sample::discrete_over(context_, place(), i.count, term()));
            case Code::Fault:
                return rddl::fault<double>(context_, place());
        }
        own_mistake("an instruction without a value");
    }

    // Relaxed: bools are between 0 and 1, ints any real.
    double soft(const Relaxation& relaxation) const {
        const Instruction& i = instruction_;
        switch (i.code) {
            case Code::IntOperator:
                return soft_int();
            case Code::ToInt:
                return i.op == Operator::Sign ? std::tanh(relaxation.sharpness * a()) : exact();
            case Code::Comparison:
                return soft_comparison(relaxation.sharpness * (a() - b()));
            case Code::Logic:
                return soft_logic();
            case Code::Select:
                return blend();
            case Code::GuardedProduct:
                return a() * b();
            case Code::ForAll:
                return soft_for_all();
            case Code::Exists:
                return soft_exists();
            case Code::Bernoulli:
                return soft_bernoulli(relaxation.temperature);
            case Code::RealOperator:
            case Code::Sum:
            case Code::IntSum:
            case Code::ArgMin:
            case Code::ArgMax:
            case Code::Gather:
            case Code::DrawReal:
            case Code::DrawInt:
            case Code::Binomial:
            case Code::Discrete:
            case Code::Fault:
                break;
        }
        return exact();
    }

    // The operand of a Gather that its index chooses.
    Slot chosen() const {
        const double last = instruction_.count - 1.0;
        const double index = a() > 0 ? std::min(std::nearbyint(a()), last) : 0.0;
        return program_.operands[instruction_.first + static_cast<std::size_t>(index)];
    }

  private:
    double a() const { return get_(instruction_.a); }
    double b() const { return instruction_.b == no_slot ? a() : get_(instruction_.b); }
    rddl::Place place() const {
        if (program_.places.empty()) return {};
        return program_.places[instruction_.place];
    }
    static std::int64_t whole(double value) { return rddl::truncate_to_int(std::nearbyint(value)); }
    static double real(std::int64_t value) { return static_cast<double>(value); }
    static double truth(bool value) { return value ? 1.0 : 0.0; }

    auto term() const {
        return [this](std::int64_t i) {
            return get_(program_.operands[instruction_.first + static_cast<std::size_t>(i)]);
        };
    }
    double sum() const {
        double total = 0;
        for (std::int64_t i = 0; i < instruction_.count; ++i) total += term()(i);
        return total;
    }
    std::uint32_t first_with(double value) const {
        std::uint32_t i = 0;
        while (i < instruction_.count && term()(i) != value) ++i;
        return i;
    }

    double soft_int() const {
        const Operator op = instruction_.op;
        if (op == Operator::Add) return a() + b();
        if (op == Operator::Subtract) return a() - b();
        if (op == Operator::Multiply) return a() * b();
        if (op == Operator::Negate) return -a();
        if (op == Operator::Abs) return std::abs(a());
        if (op == Operator::Minimum) return std::min(a(), b());
        if (op == Operator::Maximum) return std::max(a(), b());
        return exact();
    }

    double soft_comparison(double z) const {
        if (is_one_of(instruction_.op, {Operator::Equal, Operator::NotEqual})) {
            const double t = std::tanh(z);
            return instruction_.op == Operator::Equal ? 1 - t * t : t * t;
        }
        return sigmoid(is_one_of(instruction_.op, {Operator::Less, Operator::LessEqual}) ? -z : z);
    }

    double soft_logic() const {
        const Operator op = instruction_.op;
        if (op == Operator::And) return a() * b();
        if (op == Operator::Or) return 1 - (1 - a()) * (1 - b());
        if (op == Operator::Not) return 1 - a();
        if (op == Operator::Implies) return 1 - a() * (1 - b());
        if (op == Operator::NotEqual) return a() + b() - 2 * a() * b();
        return 1 - a() - b() + 2 * a() * b();  // Equivalent, Equal
    }

    // A branch with weight 0 may be infinite.
    double blend() const {
        const double condition = a();
        double value = 0;
        if (condition != 0) value += condition * get_(instruction_.b);
        if (condition != 1) value += (1 - condition) * get_(instruction_.c);
        return value;
    }

    double soft_for_all() const {
        double all = 1;
        for (std::int64_t i = 0; i < instruction_.count; ++i) all *= term()(i);
        return all;
    }
    double soft_exists() const {
        double nothing = 1;
        for (std::int64_t i = 0; i < instruction_.count; ++i) nothing *= 1 - term()(i);
        return 1 - nothing;
    }

    // The exact draw is true where logit(p) > logit(u).
    double soft_bernoulli(double temperature) const {
        const double drawn = exact();  // records faults
        const double p = a();
        if (!(p > 0 && p < 1)) return drawn;
        const double u = rddl::open_unit_real(rddl::uniform_at(context_, place()));
        const auto logit = [](double x) {
            return std::log(x / (1 - x));
        };
        return sigmoid((logit(p) - logit(u)) / temperature);
    }

    const StraightLine& program_;
    const Instruction& instruction_;
    const Get& get_;
    Context& context_;
};

}  // namespace rddlc::autodiff
