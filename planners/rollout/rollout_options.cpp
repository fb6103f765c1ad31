#include "planners/rollout/rollout_options.hpp"

namespace rddlc::planners {

namespace {

using solvers::number_option;

solvers::OptionTable<RolloutOptions> make_rollout_table() {
    using Its = RolloutOptions;
    solvers::OptionTable<Its> table =
        common_options<Its>("Batches of roll-outs of a decision",
                            "Steps of a roll-out (to the end of the episode, at most 1000)",
                            "The policy that is improved: learned, random, noop, rddl or a trace");
    table.push_back(particles_option<Its>());
    table.push_back(number_option<Its, int>(
        {"lanes", "lanes", "N", "Roll-outs side by side (256)"},
        [](auto& o) -> auto& { return o.lanes; }, 1, 1 << 20));
    table.push_back(number_option<Its, int>(
        {"actions", "actions", "N",
         "Actions that are compared, at most; of more, and of reals, so many are drawn (256)"},
        [](auto& o) -> auto& { return o.actions; }, 2, 1 << 16));
    table.push_back(number_option<Its, double>(
        {"confidence", "confidence", "Z",
         "Standard errors by which an action has to be better than the policy's (1)"},
        [](auto& o) -> auto& { return o.confidence; }, 0.0, 100.0));
    return table;
}

}  // namespace

const solvers::OptionTable<RolloutOptions>& rollout_option_table() {
    static const solvers::OptionTable<RolloutOptions> table = make_rollout_table();
    return table;
}

}  // namespace rddlc::planners
