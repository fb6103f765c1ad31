// The loops over several objects at once that draw normals in every step. One environment makes
// them together before the step (rddl/object_lanes/step_normals.hpp).
#pragma once

#include "ir/analysis.hpp"
#include "ir/ir.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace rddlc::cpp {

class StepNormals {
  public:
    struct Loop {
        std::uint32_t series;
        std::vector<ir::VariableId> variables;
    };

    StepNormals() = default;
    // Properties are by NodeId.
    StepNormals(const ir::Program& program, const std::vector<ir::Properties>& properties);

    // Empty where there is too little to make together.
    const std::vector<Loop>& loops() const { return loops_; }
    // The loop of a draw.
    std::optional<std::size_t> find(const ir::Place& place) const;

  private:
    std::vector<Loop> loops_;
    std::map<ir::Place, std::size_t> found_;
};

}  // namespace rddlc::cpp
