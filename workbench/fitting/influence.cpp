#include "fitting/influence.hpp"

#include "support/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace rddlc::workbench {

namespace {

using autodiff::Code;
using autodiff::Instruction;
using autodiff::no_slot;
using autodiff::Slot;
using autodiff::StraightLine;

// Whether its derivative is 0 without a relaxation (the table in docs/planning.md).
bool has_no_derivative(Code code) {
    switch (code) {
        case Code::IntOperator:
        case Code::ToInt:
        case Code::Comparison:
        case Code::Logic:
        case Code::IntSum:
        case Code::ForAll:
        case Code::Exists:
        case Code::ArgMin:
        case Code::ArgMax:
        case Code::Bernoulli:
        case Code::DrawInt:
        case Code::Binomial:
        case Code::Discrete:
        case Code::Fault:
            return true;
        case Code::RealOperator:
        case Code::Select:
        case Code::GuardedProduct:
        case Code::Sum:
        case Code::Gather:
        case Code::DrawReal:
            return false;
    }
    return false;
}

// Whether the condition of a choice or the index of a list is its first operand.
bool chooses_by_first(Code code) {
    return code == Code::Select || code == Code::Gather;
}

// The slots that depend on the input. With `smooth`, paths through instructions whose derivatives
// are 0 do not count.
std::vector<bool> dependent_slots(const StraightLine& step, Slot input, bool smooth) {
    std::vector<bool> depends(step.slot_count);
    depends[input] = true;
    const auto is_dependent = [&](Slot slot) {
        return slot != no_slot && depends[slot];
    };
    for (const Instruction& each : step.instructions) {
        if (each.out == no_slot || (smooth && has_no_derivative(each.code))) continue;
        const bool by_first = !(smooth && chooses_by_first(each.code)) && is_dependent(each.a);
        const auto begin = step.operands.begin() + each.first;
        if (by_first || is_dependent(each.b) || is_dependent(each.c) ||
            std::any_of(begin, begin + each.count, is_dependent))
            depends[each.out] = true;
    }
    return depends;
}

}  // namespace

Influence influence_of(const StraightLine& step, Slot input, std::span<const Slot> compared,
                       bool has_rewards) {
    const std::vector<bool> all = dependent_slots(step, input, false);
    const std::vector<bool> smooth = dependent_slots(step, input, true);
    Influence found{.has_rewards = has_rewards};
    found.on_reward = all[step.reward];
    found.is_smooth = has_rewards && smooth[step.reward];
    for (const Slot slot : compared) {
        found.on_next = found.on_next || all[slot];
        found.is_smooth = found.is_smooth || smooth[slot];
    }
    // The parameter itself stays as it is.
    found.on_others =
        std::ranges::any_of(step.next, [&](Slot slot) { return slot != input && all[slot]; });
    return found;
}

void refuse_without_influence(const std::string& name, const Influence& influence) {
    if (influence.is_smooth)
        throw Failure(fmt::format("no recorded step depends on '{}'", name),
                      "fit the others, or record steps where it matters");
    if (influence.on_next || (influence.on_reward && influence.has_rewards))
        throw Failure(
            fmt::format("derivatives by '{}' are 0: it acts only through comparisons, roundings, "
                        "or draws of bools and ints",
                        name),
            "fit the others; docs/planning.md has the table of what has derivatives");
    if (influence.on_reward)
        throw Failure(fmt::format("only rewards depend on '{}', and the traces have none", name),
                      "fit the others, or record rewards");
    if (influence.on_others)
        throw Failure(fmt::format("only bools, ints and objects of the next state depend on '{}', "
                                  "and a fit compares reals and rewards",
                                  name),
                      "fit the others");
    throw Failure(fmt::format("no recorded step depends on '{}'", name),
                  "fit the others: nothing that is compared reads it");
}

}  // namespace rddlc::workbench
