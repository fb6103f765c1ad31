// The rows of the pipeline. The runner (passes.cpp) and the descriptions are made from them.
#pragma once

#include "ir/ir.hpp"
#include "passes/passes.hpp"
#include "passes/report.hpp"

#include <span>
#include <string_view>

namespace rddlc::passes {

enum Trait : unsigned {
    only_fast_math = 1,
    leaves_out_zeros = 2,  // terms that are multiplied by zero, if they are finite
    may_find_more = 4,     // its results may hold more work of the same kind
    always_runs = 8,       // also where it is to be left out, since emit/ needs its results
    adds_tests = 16,       // of work that they skip; the cost model counts it as if it were done
};

struct Pass {
    std::string_view name;
    Phase phase;
    ir::Program (*run)(ir::Program, Report&);
    std::string_view summary;
    const char* after[2];  // names; NULL: no more
    std::string_view because;
    unsigned traits = 0;

    constexpr bool has(Trait trait) const { return (traits & trait) != 0; }
};

// The passes in the order in which they run. A pass may stand there several times.
std::span<const Pass> pipeline();

}  // namespace rddlc::passes
