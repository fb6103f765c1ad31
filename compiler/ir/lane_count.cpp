#include "ir/lane_count.hpp"

#include "ir/cost_model.hpp"
#include "ir/layout.hpp"

#include <cstddef>

namespace rddlc::ir {
namespace {

constexpr int few = suitable_lane_counts.front(), many = suitable_lane_counts.back();

// Measured by benchmarks/lanes.py: at 30 and more there is a clear gain, and below 5 a loss.
// Between them is little to gain, and batches of less than `many` environments lose.
constexpr double least_ratio = 20;
constexpr std::size_t cache_bytes = 32 << 10;

}  // namespace

int suitable_lane_count(const Program& program) {
    if (many * record_layout(program, Storage::Action).size > cache_bytes) return few;
    const PackCost cost = pack_cost_of_step(program);
    return cost.block > least_ratio * cost.numbers ? many : few;
}

}  // namespace rddlc::ir
