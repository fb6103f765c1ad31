// Why a parameter has no derivatives.
#pragma once

#include "autodiff/straight_line.hpp"

#include <span>
#include <string>

namespace rddlc::workbench {

// How a step depends on one of its inputs, by its instructions.
struct Influence {
    bool on_next = false;  // reals of the next state
    bool on_reward = false;
    bool on_others = false;    // bools, ints and objects of the next state
    bool is_smooth = false;    // a path to what is compared has derivatives other than 0
    bool has_rewards = false;  // the traces have any
};

// `compared` are the slots of those numbers of the next state that are compared.
Influence influence_of(const autodiff::StraightLine& step, autodiff::Slot input,
                       std::span<const autodiff::Slot> compared, bool has_rewards);

// Throws the Failure that says why no derivative by the parameter of that name differs from 0.
[[noreturn]] void refuse_without_influence(const std::string& name, const Influence& influence);

}  // namespace rddlc::workbench
