// Owning a batch of a simulator.
#pragma once

#include "support/failure.hpp"

#include <rddl/simulator.h>

#include <memory>

namespace rddlc::cli {

using Batch = std::unique_ptr<rddl_batch, void (*)(rddl_batch*)>;

inline Batch create_batch(const rddl_simulator& simulator, const rddl_batch_options& options) {
    Batch batch(simulator.create(&simulator, &options), simulator.destroy);
    if (!batch) throw Failure("not enough memory for so many environments", "try a smaller batch");
    return batch;
}

}  // namespace rddlc::cli
