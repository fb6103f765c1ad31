// Definitions of the domain by expressions: CPFs, reward, conditions.
#pragma once

#include "check/blocks.hpp"
#include "check/scope.hpp"

#include <optional>
#include <vector>

namespace rddlc::checking {

// The definition to which an expression belongs; decides what it may depend on.
enum class Definition : std::uint8_t {
    Derived,
    Interm,
    NextState,
    Observ,
    Reward,
    ActionPrecondition,
    StateInvariant,
    Termination,
    InitialValue,
    // Definitions of a policy.
    PolicyAction,
    PolicyDerived,
    PolicyState,
};

// The fluents that a CPF mentions.
struct CpfUses {
    std::size_t cpf;  // index into Model::cpfs or Policy::cpfs
    std::vector<FluentUse> uses;
};

// cpfs.cpp: fills Model::cpfs in the order written.
std::vector<CpfUses> check_cpfs(const Blocks& blocks, Context& context);
// The same of the policy, whose fluents have been declared.
std::vector<CpfUses> check_policy_cpfs(const Blocks& blocks, Context& context);

// conditions.cpp: reward, preconditions, invariants, terminations.
void check_reward(const Blocks& blocks, Context& context);
void check_conditions(const Blocks& blocks, Context& context);

// dependencies.cpp
// Reports what a definition mentions but may not; `what` names it in messages.
void check_dependencies(Definition definition, const std::string& what,
                        const std::vector<FluentUse>& uses, Context& context);
// Sorts the CPFs of a block by level, then by name; reports cycles.
void order_cpfs(std::vector<model::Cpf>& cpfs, const std::vector<CpfUses>& uses, Context& context);

}  // namespace rddlc::checking
