// All outcomes of a step, by the interpreter: every combination of what the step draws.
#pragma once

#include "ir/interpreter.hpp"
#include "ir/outcomes.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace rddlc::workbench {

struct ListedOutcome {
    const std::byte* next;  // a state record; bytes between fluents are 0
    double probability;     // of this combination; several may lead to the same state
    double reward;
    std::uint8_t causes;  // of an end, besides the horizon
};

// Used by one thread.
class StepOutcomes {
  public:
    // `interpreter` must outlive it.
    explicit StepOutcomes(const ir::Interpreter& interpreter);

    // Visits the outcomes; `visit` returns whether to go on. An outcome with a fault has no state
    // and no reward. Throws a Failure where a draw has no finite list of values.
    void visit(const std::byte* state, const std::byte* action, std::int64_t steps,
               const std::function<bool(const ListedOutcome&)>& visit);
    // The same for what the start of an episode draws; rewards are 0.
    void visit_starts(const std::function<bool(const ListedOutcome&)>& visit);

    bool is_legal(const std::byte* state, const std::byte* action);

  private:
    std::uint8_t causes_in(const std::byte* state, rddl::Context<rddl::Scalar>& context) const;

    const ir::Interpreter& interpreter_;
    std::vector<std::byte> scratch_, observation_, next_;
};

// Throws a Failure where conditions draw at random: whether they hold is not part of an outcome.
void require_certain_conditions(const ir::Program& program);

}  // namespace rddlc::workbench
