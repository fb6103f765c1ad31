// Twins in plan:uct: actions with the same typical outcome. One of them stands for all in the tree,
// until draws show that they differ.
#include "planners/simulation/random_stream.hpp"
#include "planners/uct/uct.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace rddlc::planners {

namespace {

// Draws of a state's first comparison. Each further one doubles all draws so far.
constexpr std::int32_t first_draws = 4;
// Twins that so many draws found equal are the same action.
constexpr std::int32_t enough_draws = 32;
// A comparison takes at most so many steps for each trial that came to the node.
constexpr std::int32_t steps_of_trial = 2;

std::int32_t next_draws(std::int32_t compared) {
    return std::max(first_draws, compared);
}

// The first move with the same typical outcome.
const DeterminisedProblem::Move& twin_of(const DeterminisedProblem::Move& move,
                                         std::span<const DeterminisedProblem::Move> moves) {
    return *std::ranges::find_if(moves, [&move](const auto& one) {
        return one.next == move.next && one.reward == move.reward;
    });
}

}  // namespace

std::int32_t Uct::twins_at(DeterminisedProblem::StateId state) const {
    const DeterminisedProblem& determinised = memory_->determinised;
    const auto twins = static_cast<std::int32_t>(determinised.twins(state).size());
    if (twins == 0 || !simulator_.problem->stochastic)
        return std::numeric_limits<std::int32_t>::max();
    return 2 * twins * next_draws(determinised.compared(state)) / steps_of_trial;
}

// The root's are compared at once, if that costs little.
void Uct::compare_all_twins(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter) {
    const auto state = memory_->determinised.state_of(tree().state(root_));
    const auto twins = static_cast<std::int64_t>(memory_->determinised.twins(state).size());
    if (!meter.has_room(10 * 2 * twins * enough_draws, 0)) return;
    while (tree().node(root_).twins_at < std::numeric_limits<std::int32_t>::max()) {
        const std::int32_t before = memory_->determinised.compared(state);
        compare_twins(root_, point, stream, meter);
        if (memory_->determinised.compared(state) == before) return;
    }
}

// Another node of the same state may have found moves since this one was opened.
void Uct::compare_twins(NodeId id, const DecisionPoint& point, RandomStream& stream,
                        BudgetMeter& meter) {
    DeterminisedProblem& determinised = memory_->determinised;
    const auto state = determinised.state_of(tree().state(id));
    if (!determinised.is_open(state)) return;
    if (!determinised.twins(state).empty()) {
        const std::int32_t draws = next_draws(determinised.compared(state));
        if (!draw_twins(id, state, draws, point, stream, meter)) return;
        determinised.add_comparison(state, draws, differs_);
        if (determinised.compared(state) >= enough_draws) determinised.forget_twins(state);
    }
    tree().node(id).twins_at = twins_at(state);
    if (determinised.moves(state).size() == tree().node(id).edge_count) return;
    add_late_moves(id, state);
    if (options_.policy.empty()) return;
    tree().node(id).has_priors = false;  // some of its edges have none
    new_nodes_.assign(1, id);
    find_priors(point, stream, meter);
}

// They have the estimates of their twins.
void Uct::add_late_moves(NodeId id, DeterminisedProblem::StateId state) {
    const auto moves = memory_->determinised.moves(state);
    Node& node = tree().node(id);
    tree().reopen_edges(id);
    const auto edge_of = [&](const DeterminisedProblem::Move& move) {
        const auto edges = tree().edges(node);
        const auto found = std::ranges::find(edges, move.action, &Edge::action);
        return found == edges.end() ? nullptr : &*found;
    };
    for (const auto& move : moves) {
        if (edge_of(move)) continue;
        const EdgeId twin = tree().id_of(*edge_of(twin_of(move, moves)));
        const double estimate = tree().first_value(twin).estimate;
        tree().add_estimate(id, tree().add_edge(id, move.action), estimate);
    }
    tree().value_node(node);
}

// Twins and their moves take steps with the same luck.
bool Uct::draw_twins(NodeId id, DeterminisedProblem::StateId state, std::int32_t draws,
                     const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter) {
    const auto moves = memory_->determinised.moves(state);
    const auto twins = memory_->determinised.twins(state);
    differs_.assign(twins.size(), 0);
    const std::size_t all = twins.size() * static_cast<std::size_t>(draws);
    const std::size_t pairs = std::max<std::size_t>(1, continuations_.lanes() / 2);
    for (std::size_t first = 0; first < all; first += pairs) {
        starts_.clear();
        const std::size_t count = std::min(pairs, all - first);
        for (std::size_t k = first; k < first + count; ++k) {
            const auto& twin = twins[k % twins.size()];
            const std::uint64_t luck = stream.bits();
            for (const std::uint32_t action : {twin_of(twin, moves).action, twin.action})
                starts_.push_back(
                    {tree().state(id), tree().node(id).step, actions_.record(action), 1, luck});
        }
        if (!meter.has_room(static_cast<std::int64_t>(starts_.size()), 0) ||
            !continuations_.run(point, starts_, policies_[policy_], meter))
            return false;
        for (std::size_t k = 0; k < count; ++k)
            if (!has_same_outcome(2 * k, 2 * k + 1)) differs_[(first + k) % twins.size()] = 1;
    }
    return true;
}

bool Uct::has_same_outcome(std::size_t k, std::size_t j) const {
    return continuations_.first_reward(k) == continuations_.first_reward(j) &&
           continuations_.is_cut(k) == continuations_.is_cut(j) &&
           std::memcmp(continuations_.first_state(k), continuations_.first_state(j), state_size_) ==
               0;
}

}  // namespace rddlc::planners
