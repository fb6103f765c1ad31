// The requirements of the functions behind Call, in one table. External functions accept any
// arguments.
#pragma once

#include "ir/ir.hpp"

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace rddlc::ir {

struct CallSignature {
    std::vector<std::size_t> input_axes;  // 1: a vector, 2: a square matrix; the elements are Real
    bool overwrites_inputs;               // to work in them: they are Scratch
    std::size_t room;                     // of the inputs, how many at the end are nothing else
    std::optional<Scalar> scalar;         // the type of the scalar, where there is one
    std::size_t output_axes;              // 0: one value
    Scalar output;
};

CallSignature signature_of(MatrixOperator op);
CallSignature signature_of(VectorDistribution distribution);

bool is_external(const Callee& callee);

// The name as in RDDL: "cholesky", "Dirichlet", "$inflow".
std::string name_of(const Program& program, const Callee& callee);

// It draws at random, so it has a place.
bool is_draw(const Callee& callee);

// The dimension over which vectors and matrices range: the last one of the first input.
struct Extent {
    std::int64_t size;
    std::uint32_t type;  // index into Program::types
};
Extent extent_of(const Program& program, const Call& call);

// The buffers that the call changes: the output, and inputs that it works in.
std::vector<BufferId> written_buffers(const Call& call);
// The buffers that the stores and calls of a block change, those of nested loops included.
std::set<BufferId> written_buffers(const Block& block);
bool overwrites_inputs(const Callee& callee);
// Whether it is a function that Together computes.
bool is_sine_or_cosine(const Node& node);
// Whether a value can be computed before a block that fills these buffers: it neither reads one nor
// is made of a local value.
bool is_known_before(const Program& program, NodeId id, const std::set<BufferId>& filled);

// The dimensions of a view that have no index: what the function gets. Empty for one element.
std::span<const std::int64_t> axes_of(const Program& program, const TableView& view);

}  // namespace rddlc::ir
