#include "autodiff/instruction_value.hpp"

namespace rddlc::autodiff {

double constant_value(const StraightLine& program, const Instruction& instruction,
                      const std::function<double(Slot)>& value) {
    Context context{};
    return InstructionValue(program, instruction, value, context).exact();
}

}  // namespace rddlc::autodiff
