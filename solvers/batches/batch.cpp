#include "solvers/batches/batch.hpp"

#include "support/memory.hpp"

#include <fmt/format.h>

namespace rddlc::solvers {

void require_done(const rddl_simulator& simulator, rddl_error error) {
    if (error != RDDL_OK) throw Failure(simulator.last_error(&simulator));
}

// Two states, as a step needs them, and what is known about each episode.
std::int64_t bytes_per_environment(const rddl_simulator& simulator) {
    constexpr std::int64_t bytes_of_episode = 80;  // with the stream of its random numbers
    const std::int64_t memory = simulator.policy ? simulator.policy->memory_size : 0;
    const rddl_problem& problem = *simulator.problem;
    return 2 * problem.state_size + 2 * problem.action_size + problem.observation_size +
           2 * memory + bytes_of_episode;
}

void require_memory(const rddl_simulator& simulator, std::int64_t environments,
                    std::int64_t limit) {
    const double bytes =
        static_cast<double>(bytes_per_environment(simulator)) * static_cast<double>(environments);
    if (bytes <= static_cast<double>(limit)) return;
    throw Failure(
        fmt::format("{} environments take about {}, more than the limit of {}", environments,
                    memory_text(bytes), memory_text(static_cast<double>(limit))),
        "try a smaller batch, fewer threads, or a larger --memory-limit");
}

std::string fault_text(const rddl_simulator& simulator, const rddl_batch& batch,
                       std::int64_t environment) {
    rddl_fault fault{};
    if (simulator.get_fault(&batch, environment, &fault) != RDDL_OK || !fault.faulty) return {};
    return fault.message;
}

}  // namespace rddlc::solvers
