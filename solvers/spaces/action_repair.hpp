// Actions that violate a precondition, made legal.
#pragma once

#include "solvers/batches/stops.hpp"
#include "solvers/policies/random_policy.hpp"
#include "solvers/spaces/actions.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace rddlc::solvers {

// One environment's search, by questions whether an action is legal of which the first values are
// as wanted and the others as in a legal action, its base.
struct RepairSearch {
    enum class Question {
        All,     // is it legal now?
        Middle,  // which value is at fault?
        Value    // is the value, as it was halved, still at fault?
    } question = Question::Middle;
    bool active = false;
    bool has_base = false;
    int legal = 0;  // with so many values it is legal
    int end = 0;    // with so many it is not
    int halves = 0, repaired = 0;

    int asked(int columns) const {
        return question == Question::All     ? columns
               : question == Question::Value ? legal + 1
                                             : (legal + end) / 2;
    }
};

// Buffers that are kept, so that nothing is allocated repeatedly.
struct RepairBuffers {
    RepairBuffers() = default;
    RepairBuffers(const rddl_simulator& simulator, const ActionSpace& space,
                  std::int64_t environments);

    std::vector<std::int32_t> violated;                 // a number an environment
    std::vector<float> wanted, bases;                   // rows of values
    std::vector<RepairSearch> searches;                 // one an environment
    std::vector<std::uint8_t> is_real;                  // by column: not of ints
    std::optional<RandomPolicy> random;                 // for bases
    std::vector<RandomPolicy::Search> random_searches;  // one an environment
    const Stops* stops = nullptr;                       // where the work ends early
};

// Values at fault fall back toward those of a legal action: a real by halves at first, then all the
// way. Checks of actions of which only the first values are set find the values at fault. The legal
// action is the default. If the default is illegal, for example because one bool of a group has to
// change, the legal action keeps the wanted discrete choices and resets the numbers, or else is a
// random one. If no legal action is found, an action stays as it is.
//
// `actions` are rows of values, `records` the same as records; both are changed. Returns how many
// actions were illegal.
std::int64_t repair_actions(const rddl_simulator& simulator, const ActionSpace& space,
                            const ActionRecords& converter, rddl_batch* batch, float* actions,
                            std::byte* records, RepairBuffers& buffers);

}  // namespace rddlc::solvers
