#include "passes/analyses/constant_values.hpp"

#include "ir/nest.hpp"

namespace rddlc::passes {

std::optional<std::vector<ir::Value>> constant_values(const ir::Evaluator& evaluator,
                                                      const ir::Program& program, ir::NodeId id,
                                                      const std::vector<ir::VariableId>& variables,
                                                      const std::optional<Assumed>& assumed) {
    const std::int64_t count = ir::combinations(program, variables);
    Context context;
    ir::Evaluator::Frame frame(evaluator, {}, context);
    if (assumed) evaluator.set(assumed->local, assumed->value, frame);
    std::vector<ir::Value> values;
    for (std::int64_t position = 0; position < count; ++position) {
        std::int64_t rest = position;
        for (auto variable = variables.rbegin(); variable != variables.rend(); ++variable) {
            frame.set(*variable, rest % program[*variable].size);
            rest /= program[*variable].size;
        }
        const std::optional<ir::Value> value = evaluator.value_unless_fault(id, frame);
        if (!value) return std::nullopt;
        values.push_back(*value);
    }
    return values;
}

}  // namespace rddlc::passes
