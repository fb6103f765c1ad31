#include "ir/external_functions.hpp"

#include "ir/call.hpp"

namespace rddlc::ir {
namespace {

rddl_scalar scalar_of(Scalar scalar) {
    switch (scalar) {
        case Scalar::Bool:
            return RDDL_BOOL;
        case Scalar::Int:
            return RDDL_INT;
        case Scalar::Real:
            break;
    }
    return RDDL_REAL;
}

}  // namespace

rddl_array array_of(const Program& program, const TableView& view, std::byte* data) {
    const std::span<const std::int64_t> axes = axes_of(program, view);
    return {scalar_of(program[view.buffer].scalar), static_cast<std::int32_t>(axes.size()),
            axes.data(), data};
}

bool accepts(rddl_external_function function, const Program& program, const Call& call) {
    std::vector<rddl_array> arguments;
    for (const TableView& input : call.inputs) {
        arguments.push_back(array_of(program, input, nullptr));
    }
    const rddl_array result = array_of(program, call.output, nullptr);
    return function(arguments.data(), static_cast<std::int32_t>(arguments.size()), &result) != 0;
}

}  // namespace rddlc::ir
