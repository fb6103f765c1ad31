// The room that a simulator takes, known before anybody takes it.
#pragma once

#include "ir/ir.hpp"
#include "support/diagnostic.hpp"

#include <cstdint>

namespace rddlc {

// Reports a program of which one environment takes more than `limit` bytes, by its largest fluent
// (E0604).
void report_memory(const ir::Program& program, std::int64_t limit, Diagnostics& diagnostics);

}  // namespace rddlc
