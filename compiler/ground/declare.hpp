// Types, fluents and their buffers: everything of the program that is not computed.
#pragma once

#include "ir/ir.hpp"
#include "model/model.hpp"

#include <optional>
#include <vector>

namespace rddlc::grounding {

// The buffer from which a fluent is read, and, for a state-fluent, the one of its next value.
struct FluentBuffers {
    ir::BufferId current;
    std::optional<ir::BufferId> next;
};

struct Declarations {
    ir::Program program;
    std::vector<FluentBuffers> buffers;  // by model::FluentId
};

// The program is for moderate values only, or for any (ir::Program::only_moderate).
Declarations declare(const model::Model& model, bool only_moderate);

ir::Scalar scalar_of(model::ValueType type);

}  // namespace rddlc::grounding
