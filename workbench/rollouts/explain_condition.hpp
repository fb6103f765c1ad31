// Why a condition does not hold in a state.
#pragma once

#include "ir/evaluator.hpp"
#include "ir/ir.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rddlc::workbench {

struct Explanation {
    std::vector<std::string> bindings;  // "?r = t2": the first objects for which it fails
    std::vector<std::string>
        values;         // "release(t2) = 30.5": the values that it reads there, each once
    std::string fault;  // what could not be evaluated; empty if all could

    // "at ?r = t2: release(t2) = 30.5, rlevel(t2) = 12.25"; may be empty
    std::string text() const;
};

// Nothing if the condition holds without a fault. It belongs to a program as `ground` leaves it:
// later passes would hide what was written. `records` are those that the condition reads, `context`
// is the one in which it is evaluated.
std::optional<Explanation> explain_condition(const ir::Program& program,
                                             const ir::Evaluator& evaluator,
                                             const ir::Computation& condition, ir::Records records,
                                             const Context& context);

}  // namespace rddlc::workbench
