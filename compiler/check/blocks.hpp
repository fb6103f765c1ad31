// Chooses which of the written blocks and sections count.
#pragma once

#include "check/context.hpp"

#include <optional>

namespace rddlc::checking {

// The last section of each kind, taken from the last block of each kind; the others are forgotten.
// Objects and non-fluents come from the non-fluents block that the instance names or, in the 2018
// form, from the instance.
struct Blocks {
    const ast::Domain* domain = nullptr;
    const ast::Instance* instance = nullptr;
    const ast::Policy* policy = nullptr;
    // Objects and non-fluents are given, by an instance or by a block of their own. A block that is
    // missing is an empty one.
    bool has_objects = false;

    const ast::Types* types = nullptr;
    const ast::PVariables* pvariables = nullptr;
    const ast::Cpfs* cpfs = nullptr;
    const ast::Reward* reward = nullptr;
    const ast::Constraints* terminations = nullptr;
    const ast::Constraints* action_preconditions = nullptr;
    const ast::Constraints* state_action_constraints = nullptr;
    const ast::Constraints* state_invariants = nullptr;

    // Sections of the policy.
    const ast::PVariables* policy_pvariables = nullptr;
    const ast::Cpfs* policy_cpfs = nullptr;

    const ast::Objects* objects = nullptr;
    const ast::NonFluentValues* non_fluents = nullptr;
    const ast::InitState* init_state = nullptr;
    const ast::MaxNondefActions* max_nondef_actions = nullptr;
    const ast::Horizon* horizon = nullptr;
    const ast::Discount* discount = nullptr;

    // Places of horizon, max-nondef-actions and the like, for messages.
    Span max_nondef_actions_span = {};
    Span horizon_span = {};
    Span discount_span = {};
    Span state_action_constraints_span = {};
};

// Reports missing blocks and sections, and repeated ones; returns nothing if too much is missing to
// continue. There is no instance if the context needs none and the program has none.
std::optional<Blocks> choose_blocks(const ast::Program& program, Context& context);

// Horizon, discount and max-nondef-actions into the model, after the fluents are known.
void check_settings(const Blocks& blocks, Context& context);

}  // namespace rddlc::checking
