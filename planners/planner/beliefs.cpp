#include "planners/planner/beliefs.hpp"

#include "planners/simulation/record_hash.hpp"
#include "support/failure.hpp"

#include <algorithm>

namespace rddlc::planners {

namespace {

constexpr std::uint64_t belief_mark = 0x62656C69656673u;  // apart from the streams of decisions

}  // namespace

std::uint64_t next_history(const rddl_problem& problem, std::uint64_t history,
                           const std::byte* action, const std::byte* observation) {
    const auto bytes = [](std::int64_t size) {
        return static_cast<std::size_t>(size);
    };
    return hash_of(observation, bytes(problem.observation_size),
                   hash_of(action, bytes(problem.action_size), history));
}

Beliefs::Beliefs(const rddl_simulator& simulator, std::int64_t particles, std::int64_t environments,
                 std::int64_t horizon, std::uint64_t seed)
    : simulator_(simulator),
      particles_(particles),
      horizon_(horizon),
      seed_(seed),
      observation_(static_cast<std::size_t>(simulator.problem->observation_size)),
      beliefs_(static_cast<std::size_t>(environments)) {}

const Particles& Beliefs::after(const solvers::Decision& decision, std::size_t place) {
    Belief& belief = beliefs_[place];
    const std::int64_t episode = decision.episodes[place], step = decision.steps[place];
    if (!belief.particles) belief.particles.emplace(simulator_, particles_, horizon_);
    RandomStream stream(seed_ ^ belief_mark, episode, step);
    if (step == 0) {
        belief.particles->begin(stream);
        belief.history = 0;
    } else if (belief.episode == episode && belief.step + 1 == step) {
        solvers::require_done(
            simulator_, simulator_.get_observation(decision.batch, static_cast<std::int64_t>(place),
                                                   1, observation_.data()));
        belief.particles->update(belief.action.data(), observation_.data(), stream);
        belief.history = next_history(*simulator_.problem, belief.history, belief.action.data(),
                                      observation_.data());
    } else {
        throw Failure(
            "a planner that plans from observations has to see an episode from its "
            "beginning, step by step",
            "reset the environment, or let it look at the state with cheat=yes");
    }
    belief.episode = episode;
    belief.step = step;
    return *belief.particles;
}

void Beliefs::note_action(std::size_t place, const std::byte* action) {
    beliefs_[place].action.assign(action, action + simulator_.problem->action_size);
}

}  // namespace rddlc::planners
