#include "autodiff/evaluation.hpp"
#include "autodiff/instruction_value.hpp"

#include <cmath>

namespace rddlc::autodiff {

namespace {

// Calls the operation for each lane; compilers take several lanes at once.
template <class Operation>
void for_lanes(Lane& out, const Lane& a, const Lane& b, const Operation& operation) {
    for (std::size_t lane = 0; lane < lanes; ++lane) out[lane] = operation(a[lane], b[lane]);
}

// False for an operator that has no loop here.
bool compute_real(Operator op, Lane& out, const Lane& a, const Lane& b) {
    if (op == Operator::Add)
        for_lanes(out, a, b, [](double x, double y) { return x + y; });
    else if (op == Operator::Subtract)
        for_lanes(out, a, b, [](double x, double y) { return x - y; });
    else if (op == Operator::Multiply)
        for_lanes(out, a, b, [](double x, double y) { return x * y; });
    else if (op == Operator::Divide)
        for_lanes(out, a, b, [](double x, double y) { return x / y; });
    else if (op == Operator::Negate)
        for_lanes(out, a, b, [](double x, double) { return -x; });
    else if (op == Operator::Minimum)
        for_lanes(out, a, b, [](double x, double y) { return rddl::minimum(x, y); });
    else if (op == Operator::Maximum)
        for_lanes(out, a, b, [](double x, double y) { return rddl::maximum(x, y); });
    else
        return false;
    return true;
}

void compute_comparison(Operator op, Lane& out, const Lane& a, const Lane& b) {
    const auto compute = [&](auto compare) {
        for_lanes(out, a, b, [&](double x, double y) { return compare(x, y) ? 1.0 : 0.0; });
    };
    if (op == Operator::Equal)
        compute([](double x, double y) { return x == y; });
    else if (op == Operator::NotEqual)
        compute([](double x, double y) { return x != y; });
    else if (op == Operator::Less)
        compute([](double x, double y) { return x < y; });
    else if (op == Operator::LessEqual)
        compute([](double x, double y) { return x <= y; });
    else if (op == Operator::Greater)
        compute([](double x, double y) { return x > y; });
    else
        compute([](double x, double y) { return x >= y; });
}

bool gives_int(Code code) {
    return is_one_of(code,
                     {Code::IntOperator, Code::IntSum, Code::ToInt, Code::DrawInt, Code::Binomial});
}

}  // namespace

Evaluation::Evaluation(const StraightLine& program, const Relaxation& relaxation)
    : program_(program), relaxation_(relaxation) {
    values_.resize(program.slot_count);
    adjoints_.resize(program.slot_count);
    for (const Constant& constant : program.constants) values_[constant.slot].fill(constant.value);
}

void Evaluation::forward(std::span<const rddl::StreamKey> keys, std::uint32_t steps_made) {
    for (std::size_t lane = 0; lane < lanes; ++lane)
        contexts_[lane] = Context{.key = keys[lane], .step = steps_made + 1, .fault = {}};
    failed_.fill(false);
    const bool is_soft = relaxation_.mode == Mode::Soft;
    for (const Instruction& instruction : program_.instructions_of_step())
        compute(instruction, is_soft);
    for (const Instruction& instruction : program_.instructions_of_end())
        compute(instruction, false);
    for (std::size_t lane = 0; lane < lanes; ++lane)
        failed_[lane] = failed_[lane] || contexts_[lane].faulted();
}

// The commonest instructions have loops over lanes of their own.
void Evaluation::compute(const Instruction& instruction, bool is_soft) {
    Lane& out = values_[instruction.out];
    if (instruction.code == Code::Sum) {
        out.fill(0);
        for (std::uint32_t i = 0; i < instruction.count; ++i)
            for_lanes(out, out, values_[program_.operands[instruction.first + i]],
                      [](double x, double y) { return x + y; });
        return;
    }
    const bool has_operands = instruction.a != no_slot;
    if (!has_operands) return compute_each_lane(instruction, is_soft);
    const Lane& a = values_[instruction.a];
    const Lane& b = instruction.b == no_slot ? a : values_[instruction.b];
    if (instruction.code == Code::RealOperator && compute_real(instruction.op, out, a, b)) return;
    if (is_soft) return compute_each_lane(instruction, is_soft);
    if (instruction.code == Code::Comparison) return compute_comparison(instruction.op, out, a, b);
    if (instruction.code == Code::GuardedProduct)
        return for_lanes(out, a, b, [](double x, double y) { return x == 0 ? x : x * y; });
    if (instruction.code == Code::Select) {
        const Lane& otherwise = values_[instruction.c];
        for (std::size_t lane = 0; lane < lanes; ++lane)
            out[lane] = a[lane] != 0 ? b[lane] : otherwise[lane];
        return;
    }
    if (instruction.code == Code::Logic && instruction.op == Operator::And)
        return for_lanes(out, a, b, [](double x, double y) { return x * y; });
    if (instruction.code == Code::Logic && instruction.op == Operator::Not)
        return for_lanes(out, a, b, [](double x, double) { return 1 - x; });
    compute_each_lane(instruction, is_soft);
}

void Evaluation::compute_each_lane(const Instruction& instruction, bool is_soft) {
    const bool is_int = gives_int(instruction.code);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const auto get = [&](Slot slot) {
            return values_[slot][lane];
        };
        Context& context = contexts_[lane];
        const bool may_fault = instruction.guard == no_slot || get(instruction.guard) > 0.5;
        const rddl::FaultRecord before = context.fault;
        const InstructionValue value(program_, instruction, get, context);
        const double result = is_soft ? value.soft(relaxation_) : value.exact();
        values_[instruction.out][lane] = result;
        if (!may_fault) context.fault = before;
        if (is_int && may_fault && std::abs(result) > largest_int) failed_[lane] = true;
    }
}

}  // namespace rddlc::autodiff
