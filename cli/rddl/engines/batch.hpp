// Batches of a simulator, as the solvers have them.
#pragma once

#include "solvers/batches/batch.hpp"

namespace rddlc::cli {

using solvers::Batch;
using solvers::bytes_per_environment;
using solvers::create_batch;
using solvers::horizon_option;
using solvers::require_room;

}  // namespace rddlc::cli
