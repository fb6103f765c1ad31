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
    for (const Instruction& instruction : program_.instructions) compute(instruction);
    for (std::size_t lane = 0; lane < lanes; ++lane)
        failed_[lane] = failed_[lane] || contexts_[lane].faulted();
}

// The commonest instructions have loops over lanes of their own.
void Evaluation::compute(const Instruction& instruction) {
    Lane& out = values_[instruction.out];
    if (instruction.code == Code::RealOperator) {
        const Lane& a = values_[instruction.a];
        const Lane& b = instruction.b == no_slot ? a : values_[instruction.b];
        if (instruction.op == Operator::Add)
            return for_lanes(out, a, b, [](double x, double y) { return x + y; });
        if (instruction.op == Operator::Subtract)
            return for_lanes(out, a, b, [](double x, double y) { return x - y; });
        if (instruction.op == Operator::Multiply)
            return for_lanes(out, a, b, [](double x, double y) { return x * y; });
        if (instruction.op == Operator::Divide)
            return for_lanes(out, a, b, [](double x, double y) { return x / y; });
    }
    if (instruction.code == Code::Sum) {
        out.fill(0);
        for (std::uint32_t i = 0; i < instruction.count; ++i)
            for_lanes(out, out, values_[program_.operands[instruction.first + i]],
                      [](double x, double y) { return x + y; });
        return;
    }
    if (instruction.code == Code::GuardedProduct && relaxation_.mode != Mode::Soft)
        return for_lanes(out, values_[instruction.a], values_[instruction.b],
                         [](double x, double y) { return x == 0 ? x : x * y; });
    compute_each_lane(instruction);
}

void Evaluation::compute_each_lane(const Instruction& instruction) {
    const bool is_int = gives_int(instruction.code);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const auto get = [&](Slot slot) {
            return values_[slot][lane];
        };
        Context& context = contexts_[lane];
        const bool may_fault = instruction.guard == no_slot || get(instruction.guard) > 0.5;
        const rddl::FaultRecord before = context.fault;
        const InstructionValue value(program_, instruction, get, context);
        const double result =
            relaxation_.mode == Mode::Soft ? value.soft(relaxation_) : value.exact();
        values_[instruction.out][lane] = result;
        if (!may_fault) context.fault = before;
        if (is_int && may_fault && std::abs(result) > largest_int) failed_[lane] = true;
    }
}

}  // namespace rddlc::autodiff
