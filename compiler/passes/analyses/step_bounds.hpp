// Bounds that hold in every state which a step makes.
#pragma once

#include "ir/builder.hpp"
#include "ir/ir.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace rddlc::passes {

class StepBounds {
  public:
    // Ranges of values that a step computes may be right for moderate states alone.
    enum class Ranges : std::uint8_t { OfConstants, OfAll };

    // The builder must outlive this.
    StepBounds(ir::Builder& builder, Ranges ranges) : builder_(builder), ranges_(ranges) {}

    // Whether a <= b where neither is nan, by a min or max in the CPF; both are elements of the
    // state or constants.
    bool is_kept_at_most(ir::NodeId a, ir::NodeId b);

  private:
    enum class Side : std::uint8_t { AtMost, AtLeast };

    std::optional<ir::NodeId> in_next_state(ir::NodeId id);
    const ir::Definition* definition_of_next(ir::BufferId state) const;
    std::optional<ir::NodeId> element(const ir::Definition& definition,
                                      const std::vector<ir::NodeId>& indices);
    bool is_bounded(ir::NodeId value, Side side, ir::NodeId limit) const;
    bool is_within_range(ir::NodeId value, Side side, ir::NodeId limit) const;

    ir::Builder& builder_;
    Ranges ranges_;
};

}  // namespace rddlc::passes
