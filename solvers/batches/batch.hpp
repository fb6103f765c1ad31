// Owning a batch of a simulator.
#pragma once

#include "support/failure.hpp"

#include <rddl/simulator.h>

#include <cstdint>
#include <memory>
#include <string>

namespace rddlc::solvers {

using BatchHandle = std::unique_ptr<rddl_batch, void (*)(rddl_batch*)>;

inline BatchHandle create_batch(const rddl_simulator& simulator,
                                const rddl_batch_options& options) {
    BatchHandle batch(simulator.create(&simulator, &options), simulator.destroy);
    if (!batch) throw Failure("not enough memory for so many environments", "try a smaller batch");
    return batch;
}

// A batch of one environment, the one of that number. The horizon is as in rddl_batch_options: 0 is
// that of the problem.
inline BatchHandle create_environment(const rddl_simulator& simulator, std::int64_t number,
                                      std::uint64_t seed, std::int64_t horizon = 0) {
    rddl_batch_options options{};
    options.environment_count = 1;
    options.first_environment = number;
    options.seed = seed;
    options.thread_count = 1;
    options.horizon = horizon;
    return create_batch(simulator, options);
}

// Fails with the simulator's own sentence where it has refused a call: nothing has been done then.
void require_done(const rddl_simulator& simulator, rddl_error error);

// Converts the user's 0, which means no horizon, to the constant of problems.
inline std::int64_t horizon_option(std::int64_t horizon) {
    return horizon == 0 ? RDDL_NO_HORIZON : horizon;
}

// The steps of an episode in a batch with that horizon option; 0: there is no limit.
inline std::int64_t steps_of_horizon(const rddl_problem& problem, std::int64_t horizon) {
    if (horizon == RDDL_NO_HORIZON) return 0;
    return horizon == 0 ? problem.horizon : horizon;
}

// The bytes of one environment in a batch, with the records that go in and out: at least 1.
std::int64_t bytes_per_environment(const rddl_simulator& simulator);

// Fails with a sentence if so many environments take more bytes than they may.
void require_memory(const rddl_simulator& simulator, std::int64_t environments, std::int64_t limit);

// The message of its fault, which begins with "file:line:column", or nothing if the environment has
// not faulted.
std::string fault_text(const rddl_simulator& simulator, const rddl_batch& batch,
                       std::int64_t environment);

}  // namespace rddlc::solvers
