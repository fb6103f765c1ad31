#include "passes/constant_values.hpp"

namespace rddlc::passes {
namespace {

ir::Value value_of(const ir::Evaluator& evaluator, ir::Scalar type, ir::NodeId id,
                   ir::Evaluator::Frame& frame) {
    switch (type) {
        case ir::Scalar::Bool:
            return evaluator.value<bool>(id, frame);
        case ir::Scalar::Int:
            return evaluator.value<std::int64_t>(id, frame);
        case ir::Scalar::Real:
            break;
    }
    return evaluator.value<double>(id, frame);
}

}  // namespace

std::optional<std::vector<ir::Value>> constant_values(
    const ir::Evaluator& evaluator, const ir::Program& program, ir::NodeId id,
    const std::vector<ir::VariableId>& variables) {
    std::int64_t count = 1;
    for (ir::VariableId variable : variables) count *= program[variable].size;

    ir::Context context;
    ir::Evaluator::Frame frame(evaluator, {}, context);
    std::vector<ir::Value> values;
    for (std::int64_t position = 0; position < count; ++position) {
        std::int64_t rest = position;
        for (auto variable = variables.rbegin(); variable != variables.rend(); ++variable) {
            frame.set(*variable, rest % program[*variable].size);
            rest /= program[*variable].size;
        }
        values.push_back(value_of(evaluator, program[id].type, id, frame));
        if (context.fault) return std::nullopt;
    }
    return values;
}

}  // namespace rddlc::passes
