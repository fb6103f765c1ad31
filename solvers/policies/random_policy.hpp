// Uniformly random legal actions, reproducible whatever the batch and the number of threads.
//
// Values: booleans, enumerated values and bounded ints uniformly; bounded reals uniformly; reals
// bounded on one side at an exponential distance (mean 1) from the bound; unbounded reals standard
// normal; ints that are not bounded on both sides as the reals, rounded toward the inside. With a
// limit of k non-default values, k values chosen at random are drawn and the others keep their
// default. In each given group of bools, one that is chosen at random changes, or, where that is
// allowed, no bool changes.
//
// The policy does not know which actions are legal: a caller that knows asks for another one until
// one is (`try_another`). The caller may do so for many environments side by side.
#pragma once

#include "solvers/spaces/groups.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddlc::solvers {

class RandomPolicy {
  public:
    // `problem` must outlive the policy. Groups are of action values by their places in a row.
    RandomPolicy(const rddl_problem& problem, std::uint64_t seed, Groups groups = {});

    // Writes the action record with which `environment` leaves timestep `step`.
    // Depends on seed, environment and step only.
    void act(std::int64_t environment, std::int64_t step, std::byte* action);

    // How far the search for a legal action of one environment at one timestep has come.
    struct Search {
        std::uint32_t sample = 0;  // actions drawn and given up before this one
        std::uint32_t draws = 0;   // made to repair this one
        bool knows_changed = false;
        std::vector<std::uint32_t> changed = {};  // values that differ from their default

        // Restores the first state, in the same memory.
        void restart() { begin_sample(0); }
        void begin_sample(std::uint32_t number) {
            sample = number;
            draws = 0;
            knows_changed = false;
        }
    };
    // Changes an action that is not legal: of the values that differ from their default, one
    // chosen at random falls back to it (or several of them, while they are many). If that
    // is the default action already, a new action is drawn, whose bools are, fluent by fluent, all
    // default, all changed or at random; or, after many of these, one that changes a single
    // value. False, with the default action, if enough were tried.
    bool try_another(std::int64_t environment, std::int64_t step, Search& search,
                     std::byte* action);

  private:
    // One value of the action record and what to draw it from.
    struct Entry {
        enum class Kind : std::uint8_t { Bool, Int, Real } kind;
        std::uint32_t fluent;
        std::size_t offset;
        double lower, upper;  // reals, and ints with an infinite bound
        std::int64_t first;   // ints with two bounds: first .. first + count - 1;
        std::uint64_t count;  // 0: not bounded on both sides, or no int fits

        std::size_t size() const { return kind == Kind::Bool ? 1 : 8; }
    };
    struct Draws;

    static Entry entry_of(const rddl_problem& problem, std::int32_t fluent, std::int64_t grounding);
    Draws draws_of(std::int64_t environment, std::int64_t step, std::uint32_t sample) const;
    void draw_action(const Draws& draws, std::byte* action);
    void draw_single_change(std::int64_t environment, std::int64_t step, std::uint32_t sample,
                            std::byte* action) const;
    void draw(const Entry& entry, const Draws& draws, std::size_t number, std::byte* action) const;
    void draw_bool(const Entry& entry, const Draws& draws, std::uint64_t bits,
                   std::byte* action) const;
    void draw_groups(const Draws& draws, std::byte* action) const;
    bool is_changed(const Entry& entry, const std::byte* action) const;
    void reset_some(const Draws& draws, Search& search, std::byte* action) const;
    const std::byte* default_action() const {
        return static_cast<const std::byte*>(problem_->default_action);
    }

    const rddl_problem* problem_;
    std::uint64_t seed_;
    std::vector<Entry> entries_;
    std::size_t drawn_per_step_;         // at most this many values are not at their default
    std::vector<std::size_t> order_;     // identity between calls; shuffled in part during one
    std::vector<std::size_t> partners_;  // what was swapped there
    Groups groups_;
    std::vector<std::uint32_t> alone_;  // entries of no group
};

}  // namespace rddlc::solvers
