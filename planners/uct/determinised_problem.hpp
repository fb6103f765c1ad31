// The determinised problem of a lookahead: each action of a state has one outcome, the typical one
// (Keller and Eyerich, 2012). Values are by search as deep as asked for. All that was found about
// states is kept.
#pragma once

#include "planners/simulation/budget.hpp"
#include "planners/uct/state_hash.hpp"
#include "planners/uct/typical_steps.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace rddlc::planners {

class DeterminisedProblem {
  public:
    using StateId = std::uint32_t;
    struct Move {
        std::uint32_t action;
        StateId next;
        double reward;
    };
    // The best course of so many steps: the discounted sum of its rewards, and the state where it
    // ends.
    struct Course {
        double value;
        StateId end;
    };
    // Where episodes are over.
    static constexpr StateId over = 0;
    // Policies whose rewards after a search may be kept.
    static constexpr std::size_t most_policies = 2;

    DeterminisedProblem(std::size_t state_size, double discount);

    // Forgets all, and frees its memory.
    void clear() { *this = DeterminisedProblem(state_size_, discount_); }
    std::size_t bytes() const;
    StateId state_of(const std::byte* record);

    // The depth of searches from there that meet at most so many states, but no more than `most`.
    // 0: the budget does not last for one step.
    std::int64_t affordable_depth(StateId root, std::int64_t most, std::size_t most_states,
                                  TypicalSteps& steps, BudgetMeter& meter);
    // Searches from states are so deep from now on.
    void set_depth(std::int64_t depth);
    std::int64_t depth() const { return depth_; }
    // Simulates what searches from these states ask for. False where the budget does not last.
    bool open(std::span<const StateId> states, TypicalSteps& steps, BudgetMeter& meter);

    const std::byte* record(StateId state) const {
        return records_.data() + static_cast<std::size_t>(state) * state_size_;
    }
    // The mean reward of that policy's steps after that state, as the caller has found it; nan at
    // first.
    double& later(StateId state, std::size_t policy) { return states_[state].later[policy]; }
    bool is_open(StateId state) const { return states_[state].is_open; }
    // The legal actions of an open state, without twins.
    std::span<const Move> moves(StateId state) const {
        return {moves_.data() + states_[state].first_move, states_[state].move_count};
    }
    // Further legal actions, which have the same typical outcome as one of these: as far as is
    // known, the two are the same action.
    std::span<const Move> twins(StateId state) const {
        return {moves_.data() + states_[state].first_move + states_[state].move_count,
                states_[state].twin_count};
    }
    // So many draws have compared twins with their moves.
    std::int32_t compared(StateId state) const { return states_[state].compared; }
    // Further draws have: those that differ, a flag for each twin, are moves from now on.
    void add_comparison(StateId state, std::int32_t draws, std::span<const std::uint8_t> differs);
    // No draws have shown a difference: the twins are forgotten.
    void forget_twins(StateId state) { states_[state].twin_count = 0; }
    // The reward of a move from an open state, and the best course that follows, in so many steps
    // altogether: 1 .. depth().
    Course after(const Move& move, std::int64_t steps);
    // Whether no draw of any action has changed the state, and all rewards were the same.
    bool stays(StateId state) const { return states_[state].stays; }
    // Further draws have shown whether that is so.
    void confirm(StateId state, bool stays) {
        states_[state].stays = stays;
        states_[state].is_confirmed = true;
    }
    bool is_confirmed(StateId state) const { return states_[state].is_confirmed; }

  private:
    struct State {
        State() { later.fill(std::numeric_limits<double>::quiet_NaN()); }
        std::array<double, most_policies> later;
        std::uint32_t row = 0;  // of an open state: of courses_
        std::uint32_t first_move = 0, move_count = 0, twin_count = 0;
        std::int32_t compared = 0;
        std::uint32_t visit = 0;  // of a search: the last one that has met it
        bool is_open = false, stays = false, is_confirmed = false;
    };

    StateId state_of(const std::byte* record, std::uint64_t key);
    void begin_visit(std::span<const StateId> states);
    bool open_front(TypicalSteps& steps, BudgetMeter& meter);
    void take_moves(StateId state, std::size_t place, const TypicalSteps& steps);
    bool has_twin(std::size_t first, const Move& move) const;
    void move_front(std::int64_t steps_left);
    std::size_t place_of(StateId state, std::int64_t steps) const {
        return states_[state].row * width_ + static_cast<std::size_t>(steps - 1);
    }
    bool is_known(StateId state, std::int64_t steps) const;
    Course best(StateId state, std::int64_t steps);

    std::size_t state_size_;
    double discount_;
    std::int64_t depth_ = 1;
    std::vector<State> states_;
    std::vector<std::byte> records_;
    std::vector<Move> moves_;
    StateTable ids_;
    // The best courses of open states, a row for each, by steps 1 .. width_; nan: unknown. A lesser
    // depth leaves them as they are, since a course of so many steps is the same at any depth.
    std::vector<Course> courses_;
    std::size_t width_ = 1;
    std::uint32_t visit_ = 0;
    std::vector<StateId> front_, next_front_, closed_;
    std::vector<Move> twins_;
    std::vector<std::uint64_t> keys_;  // of the states after actions
    std::vector<const std::byte*> wanted_;
};

}  // namespace rddlc::planners
