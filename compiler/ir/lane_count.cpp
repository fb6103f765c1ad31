#include "ir/lane_count.hpp"

#include "ir/action_bools.hpp"
#include "ir/analysis.hpp"
#include "ir/cost_model.hpp"
#include "ir/layout.hpp"

#include <algorithm>
#include <cstddef>

namespace rddlc::ir {
namespace {

constexpr int few = suitable_lane_counts.front(), many = suitable_lane_counts.back();

// Measured by benchmarks/lanes.py: at 30 and more there is a clear gain, and below 5 a loss.
// Between them batches of less than `many` environments lose. The limit is fitted: from 16 to 20
// larger batches gain a quarter, or nothing (docs/decisions.md).
constexpr double least_ratio = 16;
// Chosen after measurements: with a share of 0.002 byte ints neither gain nor lose, with 0.05 they
// gain 7 %.
constexpr double least_share_of_ints = 0.01;
constexpr std::size_t cache_bytes = 32 << 10;
// Measured too: 4,423 bytes of actions take 160 ns of each environment in a pack, and a step of
// cost 471 takes one environment 47 ns.
constexpr double bytes_for_an_operation = 3;
// Chosen after measurements: with 48 KiB of actions, and 4 operations for a byte of them, a step in
// a pack takes 1.4 times that of one environment; with 130 for a byte packs gain.
constexpr double operations_for_a_byte = 8;

std::size_t action_size(const Program& program) {
    return record_layout(program, Storage::Action).size;
}
bool reads_few_of_many_bools(const Program& program) {
    return tests_action_bools(program) && static_cast<double>(action_size(program)) >
                                              bytes_for_an_operation * cost_of_step(program);
}
// The nearest cache does not hold the actions of the smallest pack, which reads all of them.
bool wait_for_actions(const Program& program) {
    return few * action_size(program) > cache_bytes &&
           cost_of_step(program) <
               operations_for_a_byte * static_cast<double>(action_size(program));
}
bool have_many_room(const Program& program) {
    return many * action_size(program) <= cache_bytes;
}

}  // namespace

int suitable_lane_count(const Program& program) {
    if (reads_few_of_many_bools(program) || wait_for_actions(program)) return 1;
    if (!have_many_room(program)) return few;
    const PackCost cost = pack_cost_of_step(program);
    return cost.block > least_ratio * (cost.ints + cost.reals) ? many : few;
}

bool suits_byte_ints(const Program& program) {
    if (reads_few_of_many_bools(program) || !have_many_room(program)) return false;
    const PackCost cost = pack_cost_of_step(program);
    return cost.block + cost.ints > least_ratio * cost.reals &&
           cost.ints > least_share_of_ints * cost.block;
}

std::string_view why_without_packs(const Program& program) {
    if (program.policy) return "with a policy block";
    if (std::ranges::any_of(blocks_of(program),
                            [](const Block* block) { return calls_functions(*block); }))
        return "with matrices, random vectors or external functions";
    return "";
}

}  // namespace rddlc::ir
