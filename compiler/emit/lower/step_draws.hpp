// The draws that every step makes, whose numbers one environment makes together before the step
// (rddl/object_lanes/step_numbers.hpp).
#pragma once

#include "ir/ir.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace rddlc::cpp {

// Whether packs, which make the numbers of four objects at once, or of two where no more are left,
// make fewer if they know that a loop has so many. Of many objects these are a small part
// (docs/decisions.md).
bool leaves_few_numbers(std::int64_t objects);

class StepDraws {
  public:
    // The numbers of a row are those of a loop, by its series, or of draws that are made once.
    struct Counter {
        std::uint32_t series;
        std::int64_t index;
    };
    struct Row {
        std::vector<Counter> lone = {};
        std::optional<std::uint32_t> loop = {};
    };
    // Where the numbers of a draw are; no lane: the draw of a loop has a row. Some loops visit
    // several objects at once.
    struct Where {
        std::size_t row;
        std::optional<std::size_t> lane = {};
        bool over_several = false;
    };

    StepDraws() = default;
    // `takes_lane` says of which draws outside of loops the numbers may be made before the step.
    StepDraws(const ir::Program& program, const std::function<bool(const ir::Place&)>& takes_lane);

    // Empty where there is too little to make together.
    const std::vector<Row>& rows() const { return rows_; }
    std::optional<Where> find(const ir::Place& place) const;

  private:
    std::vector<Row> rows_;
    std::map<ir::Place, Where> found_;
};

}  // namespace rddlc::cpp
