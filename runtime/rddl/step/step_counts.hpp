// How many steps the episodes of a block have made.
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/values/pack_ops.hpp>

#include <algorithm>
#include <cstdint>

namespace rddl {

// A pack has a clock, which counts the steps of its block, and the time on it when each episode
// began. So a step of all lanes counts one number, and compares it with one: the time before which
// no episode reaches the horizon. One that has reached it makes no more steps.
template <class L>
class StepCounts {
  public:
    using Bool = typename L::Bool;
    using Int = typename L::Count;

    Int all() const { return wrap_sub(Int{clock_}, begun_); }
    std::int64_t of(int lane) const { return wrap_sub(clock_, get_lane(begun_, lane)); }
    std::int64_t of_block() const { return clock_; }
    void set(int lane, std::int64_t steps) {
        set_lane(begun_, lane, wrap_sub(clock_, steps));
        look_again();
    }
    // After this, episodes that have reached the horizon may make steps.
    void look_again() { due_ = clock_; }

    // All lanes make a step; which of them reach the horizon.
    RDDL_ALWAYS_INLINE Bool count_all(std::int64_t horizon) {
        ++clock_;
        // Some of many lanes reach it soon.
        if constexpr (L::width > 16) return have_reached(horizon, clock_);
        if (clock_ < due_) [[likely]]
            return Bool{false};
        return late(horizon);
    }
    // The same for these lanes.
    Bool count(Bool lanes, std::int64_t horizon) {
        begun_ = select(lanes, begun_, wrap_add(begun_, Int{1}));
        return count_all(horizon) && lanes;
    }
    // New episodes of these lanes.
    RDDL_ALWAYS_INLINE void begin(Bool lanes) { begun_ = select(lanes, Int{clock_}, begun_); }

  private:
    Bool have_reached(std::int64_t horizon, std::int64_t time) const {
        return Bool(begun_ <= Int{time - horizon});
    }
    [[gnu::noinline]] Bool late(std::int64_t horizon) {
        const Bool are_late = have_reached(horizon, clock_);
        const auto some_within = [&](std::int64_t steps) RDDL_INLINE_LAMBDA {
            return any(have_reached(horizon, clock_ + steps) && !are_late);
        };
        const std::int64_t steps = some_within(4) ? 1 : some_within(32) ? 4 : 32;
        due_ = clock_ + std::min(steps, horizon);  // the next episodes of those that end now
        return are_late;
    }

    std::int64_t clock_ = 0;
    std::int64_t due_ = 0;
    Int begun_{std::int64_t{0}};
};

template <class R>
class StepCounts<ScalarOf<R>> {
  public:
    std::int64_t all() const { return steps_; }
    std::int64_t of(int) const { return steps_; }
    void set(int, std::int64_t steps) { steps_ = steps; }
    void look_again() {}

    RDDL_ALWAYS_INLINE bool count_all(std::int64_t horizon) {
        steps_ = wrap_add(steps_, std::int64_t{1});
        return steps_ >= horizon;
    }
    bool count(bool lanes, std::int64_t horizon) {
        if (lanes) steps_ = wrap_add(steps_, std::int64_t{1});
        return steps_ >= horizon;
    }
    void begin(bool lanes) {
        if (lanes) steps_ = 0;
    }

  private:
    std::int64_t steps_ = 0;
};

}  // namespace rddl
