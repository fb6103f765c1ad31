// Runs a program without a C++ compiler: an engine for rddl::Batch (rddl/step/engine.hpp), and the
// oracle that compiled simulators are tested against, bit for bit.
#pragma once

#include "ir/evaluator.hpp"
#include "ir/ir.hpp"
#include "ir/layout.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace rddlc::ir {

// Records are laid out by layout.hpp. All functions may run at the same time in several threads.
class Interpreter {
  public:
    using Lane = rddl::Scalar;

    // The functions are by ExternalId, and accept the calls of the program.
    explicit Interpreter(Program program, ExternalFunctions functions = {});

    const Program& program() const { return *program_; }
    // See Evaluator::round_by.
    void round_by(Rounding& rounding) { evaluator_.round_by(rounding); }

    // Sizes in bytes.
    std::size_t state_size() const { return state_size_; }
    std::size_t action_size() const { return action_size_; }
    std::size_t observation_size() const { return observation_size_; }
    std::size_t scratch_size() const { return scratch_size_; }

    // Writes the initial state, also as it is before the draws, and the default action.
    void reset(std::byte* state, Context& context) const;
    // The same with draws that are chosen.
    void reset(std::byte* state, Context& context, Outcomes* outcomes) const;
    void initial_state(std::byte* state) const;
    void default_action(std::byte* action) const;

    // Computes the next state (and the observation, which is unused when fully observed) and
    // returns the reward.
    double step(const std::byte* state, const std::byte* action, std::byte* scratch,
                std::byte* next, std::byte* observation, Context& context) const;

    // The same with draws that are chosen.
    double step(const std::byte* state, const std::byte* action, std::byte* scratch,
                std::byte* next, std::byte* observation, Context& context,
                Outcomes* outcomes) const;

    // Whether all reals of the state and the action are moderate that a program for moderate values
    // assumes so. Any other program may step from anywhere.
    bool may_step_from(const std::byte* state, const std::byte* action) const;

    // Does any termination condition hold?
    bool terminal(const std::byte* state, Context& context) const;
    // Is there an invariant that does not hold, or faults?
    bool violates_invariant(const std::byte* state, Context& context) const;
    // The first that does not hold, or faults; or -1.
    int violated_precondition(const std::byte* state, const std::byte* action,
                              Context& context) const;

    // The policy block (rddl/step/engine.hpp: PolicyEngine), if there is one.
    bool has_policy() const { return program_->policy.has_value(); }
    std::size_t memory_size() const { return memory_size_; }
    void reset_policy(std::byte* memory) const;
    void act(const std::byte* observation, const std::byte* memory, std::byte* scratch,
             std::byte* action, std::byte* next_memory, Context& context) const;

  private:
    bool holds(const Computation& condition, Records records, Context& context) const;
    int first_violated(const std::vector<Computation>& conditions, Records records,
                       Context& context) const;
    void write_initial(Storage storage, std::byte* record) const;

    std::unique_ptr<const Program> program_;
    Evaluator evaluator_;
    std::unique_ptr<const Interpreter> moderate_;    // of Program::moderate, if there is one
    std::vector<Field> state_reals_, action_reals_;  // of a program for moderate values
    std::size_t state_size_, action_size_, observation_size_, scratch_size_, memory_size_;
    bool conditions_fill_tables_, reset_fills_tables_;
};

}  // namespace rddlc::ir
