// All actions of a problem that has finitely many, and not too many.
#pragma once

#include "planners/simulation/futures.hpp"
#include "solvers/spaces/actions.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rddlc::planners {

class FiniteActions {
  public:
    // As many as the learner's space has: each category by itself, or so many sub-actions. The
    // first one is the default action, where that is one of them. Nothing where a number may be any
    // real, or where there are more than `most`.
    static std::optional<FiniteActions> of(const rddl_simulator& simulator,
                                           const solvers::ActionSpace& space, std::size_t most);

    std::size_t count() const { return count_; }
    const std::byte* record(std::size_t action) const { return records_.data() + action * size_; }
    std::span<const std::byte> records() const { return records_; }
    // Whether there are states in which some of them violate preconditions.
    bool may_be_illegal() const { return asks_; }
    // Whether each of them satisfies the preconditions in the environment of the origin; of
    // particles, in some of them. Where none does, all are taken for legal.
    void find_legal(const Origin& origin, std::vector<std::uint8_t>& legal);

  private:
    void ask(const rddl_batch* batch, std::int64_t place, std::vector<std::uint8_t>& legal);
    FiniteActions(const rddl_simulator& simulator, bool asks)
        : simulator_(&simulator), asks_(asks) {}
    void add_categories(const solvers::ActionSpace& space);
    void add_sub_actions(const solvers::ActionSpace& space);
    void add(const solvers::ActionSpace& space, const std::vector<std::int32_t>& indices);

    const rddl_simulator* simulator_;
    bool asks_;
    std::size_t count_ = 0, size_ = 0;
    std::vector<std::byte> records_;
    std::optional<Futures> lanes_;  // one for each action, to ask about all of them at once
    std::vector<std::uint64_t> streams_;
    std::vector<std::int32_t> violated_;
};

}  // namespace rddlc::planners
