#include "passes/aggregations/index_directly.hpp"

#include "passes/aggregations/take_only_objects.hpp"

#include <utility>

namespace rddlc::passes {

ir::Program index_directly(ir::Program program, Report& report) {
    return take_only_objects(
        std::move(program), [&](ir::Program& changed, ir::Builder& builder,
                                const Condition& condition, ir::VariableId variable) {
            const auto object = OnlyObjects(changed, builder).fulfilling(condition, variable);
            if (object) ++report["aggregations replaced by their only object"];
            return object;
        });
}

}  // namespace rddlc::passes
