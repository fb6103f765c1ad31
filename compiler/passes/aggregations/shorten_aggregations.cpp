#include "passes/aggregations/shorten_aggregations.hpp"

#include "passes/aggregations/factor_aggregations.hpp"
#include "passes/aggregations/hoist_aggregations.hpp"

#include <utility>

namespace rddlc {

ir::Program shorten_aggregations(ir::Program program) {
    passes::Report report;
    program = passes::factor_aggregations(std::move(program), report);
    return passes::hoist_aggregations(std::move(program), report);
}

}  // namespace rddlc
