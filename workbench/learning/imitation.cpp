#include "learning/imitation.hpp"

#include "learning/learned_policy.hpp"
#include "planners/planner/planner_policy.hpp"
#include "terminal/progress.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rddlc::workbench {

namespace {

constexpr std::uint64_t seed_of_episodes = 0x696D6974;  // not that of evaluations

// Learners load problems without a policy block of another file.
void refuse_block_file(const std::string& name) {
    if (!is_block_file(name)) return;
    throw Failure(fmt::format(
        "'{0}' holds a policy block, which learners do not load: record its episodes by "
        "'rddl run ... --policy {0} --trace episodes.jsonl', and imitate that trace",
        name));
}

void set_policy(Imitation& imitation, const std::string& name) {
    try {
        if (planners::is_planner(name))
            planners::require_planner(name);
        else
            refuse_block_file(name);
    } catch (const Failure& failure) {
        throw solvers::OptionRefused(failure.what());
    }
    imitation.policy = name;
}

solvers::OptionTable<Imitation> make_table() {
    const solvers::LearnerOption<Imitation> policy{
        {"--imitate", "imitate", "POLICY",
         "Begin as this policy acts, such as plan:cem or runs/a: for goals behind costs"},
        [](Imitation& imitation, const std::vector<std::string>& words) {
            set_policy(imitation, words.front());
        },
        [](const Imitation& imitation) {
            return imitation.policy;
        }};
    return {policy, solvers::number_option<Imitation, std::int64_t>(
                        {"--imitate-episodes", "imitate_episodes", "N",
                         "Episodes of it that are imitated (20)"},
                        [](auto& o) -> auto& { return o.episodes; }, 1, 1'000'000)};
}

}  // namespace

const solvers::OptionTable<Imitation>& imitation_option_table() {
    static const solvers::OptionTable<Imitation> table = make_table();
    return table;
}

solvers::Demonstrate demonstrate(const rddl_simulator& simulator, const Imitation& imitation,
                                 std::uint64_t seed, std::int64_t memory_limit,
                                 const PlannerSettings& planning,
                                 const std::function<bool()>& stops, bool quiet) {
    if (imitation.policy.empty()) return {};
    return [=, &simulator](const solvers::PpoModel& model) {
        solvers::EpisodeOptions episodes;
        episodes.episodes = imitation.episodes;
        episodes.seed = seed + seed_of_episodes;
        episodes.horizon = solvers::horizon_of_learners(*simulator.problem);
        const solvers::Policy policy =
            policy_named(simulator, imitation.policy, false, episodes.seed, memory_limit, planning);
        const std::int64_t steps = solvers::steps_at_most(simulator, episodes);
        Progress bar("playing " + imitation.policy,
                     episodes.episodes * std::max<std::int64_t>(steps, 1), !quiet);
        return solvers::demonstrations(simulator, model, policy, episodes,
                                       {stops, [&](std::int64_t done) { bar.advance(done); }, {}});
    };
}

}  // namespace rddlc::workbench
