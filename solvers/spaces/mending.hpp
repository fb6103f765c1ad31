// Actions that violate a precondition, made legal.
#pragma once

#include "solvers/spaces/actions.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddlc::solvers {

// One environment's search, by questions whether an action is legal of which the first values are
// as wanted and the others as in an action that is legal: the default, or else the wanted one with
// its numbers at their default.
struct MendingSearch {
    enum class Question {
        All,     // is it legal now?
        Middle,  // which value is at fault?
        Value    // is the value, as it was halved, still at fault?
    } question = Question::Middle;
    bool active = false;
    bool keeps_categories = false;  // bools and objects stay as they are wanted
    int legal = 0;                  // with so many values it is legal
    int end = 0;                    // with so many it is not
    int halves = 0, mended = 0;

    int asked(int columns) const {
        return question == Question::All     ? columns
               : question == Question::Value ? legal + 1
                                             : (legal + end) / 2;
    }
};

// What the work takes, so that nothing is allocated again and again.
struct MendingRoom {
    MendingRoom() = default;
    MendingRoom(const ActionSpace& space, std::int64_t environments);

    std::vector<std::int32_t> violated;   // a number an environment
    std::vector<float> wanted;            // rows of values
    std::vector<MendingSearch> searches;  // one an environment
    std::vector<std::uint8_t> is_number;  // by column: of a real head
    std::vector<std::uint8_t> is_real;    // by column: and not of ints
};

// Values at fault fall back toward their default: a real by halves at first, then all the way.
// Which values are at fault is found by asking about actions of which only the first ones are set.
// Where the default action is illegal, as where one bool of a group has to change, numbers alone
// fall back. Where that is illegal, too, an action stays as it is.
//
// `actions` are rows of values, `records` the same as records; both are changed. Returns how many
// actions were illegal.
std::int64_t mend_actions(const rddl_simulator& simulator, const ActionSpace& space,
                          const ActionRecords& converter, rddl_batch* batch, float* actions,
                          std::byte* records, MendingRoom& room);

}  // namespace rddlc::solvers
