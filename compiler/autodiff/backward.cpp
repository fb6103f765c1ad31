#include "autodiff/evaluation.hpp"
#include "autodiff/instruction_value.hpp"
#include "autodiff/partials.hpp"

#include <algorithm>

namespace rddlc::autodiff {

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

// The end of an episode has no derivative.
void Evaluation::backward() {
    for (std::size_t i = program_.first_of_end; i-- > 0;) propagate(program_.instructions[i]);
}

void Evaluation::add(Slot slot, std::size_t lane, double adjoint) {
    adjoints_[slot][lane] += adjoint - adjoint == 0 ? adjoint : 0;
}

// Adds the numbers of all lanes; compilers take several at once.
template <class Terms>
void Evaluation::add_lanes(Slot slot, const Terms& term) {
    Lane& to = adjoints_[slot];
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const double each = term(lane);
        to[lane] += each - each == 0 ? each : 0;
    }
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

// The commonest operators of reals. False for others.
bool Evaluation::propagate_real(const Instruction& instruction) {
    const Lane& g = adjoints_[instruction.out];
    const auto same = [&](std::size_t lane) {
        return g[lane];
    };
    if (instruction.code == Code::Sum) {
        for (std::uint32_t i = 0; i < instruction.count; ++i)
            add_lanes(program_.operands[instruction.first + i], same);
        return true;
    }
    const bool is_real = instruction.code == Code::RealOperator;
    if (is_real && instruction.op == Operator::Add) {
        add_lanes(instruction.a, same);
        add_lanes(instruction.b, same);
        return true;
    }
    if (is_real && instruction.op == Operator::Subtract) {
        add_lanes(instruction.a, same);
        add_lanes(instruction.b, [&](std::size_t lane) { return -g[lane]; });
        return true;
    }
    const bool is_product = (is_real && instruction.op == Operator::Multiply) ||
                            instruction.code == Code::GuardedProduct;
    if (!is_product) return false;
    const Lane& a = values_[instruction.a];
    const Lane& b = values_[instruction.b];
    add_lanes(instruction.a, [&](std::size_t lane) { return g[lane] * b[lane]; });
    add_lanes(instruction.b, [&](std::size_t lane) { return g[lane] * a[lane]; });
    return true;
}

void Evaluation::propagate(const Instruction& instruction) {
    const Lane& g = adjoints_[instruction.out];
    if (std::ranges::all_of(g, [](double each) { return each == 0; })) return;
    if (propagate_real(instruction)) return;
    const bool is_relaxed = relaxation_.mode != Mode::Exact;
    const Operator op = instruction.op;
    switch (instruction.code) {
        case Code::RealOperator:
            return add_partials(instruction, [op](double a, double b, double v) {
                return of_operator(op, a, b, v);
            });
        case Code::IntOperator:
            return add_partials(instruction, [&](double a, double b, double v) {
                return of_int_operator(op, a, b, v, is_relaxed);
            });
        case Code::Logic:
            return add_partials(instruction,
                                [op](double a, double b, double) { return of_logic(op, a, b); });
        case Code::DrawReal:
            return add_partials(instruction, [&](double a, double b, double v) {
                return of_real_draw(instruction.distribution, a, b, v);
            });
        case Code::ToInt:
        case Code::Comparison:
        case Code::Bernoulli:
        case Code::DrawInt:
        case Code::Binomial:
            if (is_relaxed) propagate_relaxed(instruction);
            return;
        case Code::Select:
        case Code::Gather:
        case Code::IntSum:
        case Code::ForAll:
        case Code::Exists:
        case Code::Discrete:
            return propagate_others(instruction);
        case Code::Sum:  // propagate_real() has these two
        case Code::GuardedProduct:
        case Code::ArgMin:  // these are constant almost everywhere
        case Code::ArgMax:
        case Code::Fault:
            return;
    }
}

// Instructions that have derivatives only where they are relaxed.
void Evaluation::propagate_relaxed(const Instruction& instruction) {
    const Operator op = instruction.op;
    const double sharpness = relaxation_.sharpness;
    if (instruction.code == Code::ToInt) {
        add_partials(instruction,
                     [&](double a, double, double) { return of_rounding(op, a, sharpness); });
    } else if (instruction.code == Code::Comparison) {
        add_partials(instruction, [&](double a, double b, double) {
            return of_comparison(op, a, b, sharpness);
        });
    } else if (instruction.code == Code::Bernoulli) {
        add_partials(instruction, [&](double p, double, double v) {
            if (relaxation_.mode == Mode::StraightThrough) return Partials{1};
            return Partials{v * (1 - v) / (relaxation_.temperature * p * (1 - p))};
        });
    } else if (instruction.code == Code::DrawInt) {
        add_partials(instruction, [&](double a, double b, double) {
            return of_int_draw(instruction.distribution, a, b);
        });
    } else {  // Binomial
        add_partials(instruction, [](double n, double p, double) { return Partials{p, n}; });
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
    if (instruction.code == Code::IntSum) {
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
