// The functions behind Call by number, on tables in memory: the runtime's functions, which emitted
// code calls on nested arrays.
#pragma once

#include "ir/ir.hpp"
#include "vocabulary/kernels.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace rddlc::ir {

struct TableArguments {
    std::int64_t size;
    std::array<std::byte*, 2> inputs;  // the first elements, as many as the signature says
    double real_scalar;                // the scalar, if the signature has one of this type
    std::int64_t int_scalar;
    std::byte* output;
};

void call_on_tables(MatrixOperator op, const TableArguments& arguments, rddl::Place place,
                    Context& context);
void call_on_tables(VectorDistribution distribution, const TableArguments& arguments,
                    rddl::Place place, Context& context);

}  // namespace rddlc::ir
