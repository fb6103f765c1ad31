// Products of bools as numbers are bools; so are comparisons of such numbers with constants
// (ir/simplify.cpp).
//
//     int(TURN[u, d]) * int(scratch.green[u])   int(TURN[u, d] && scratch.green[u])
//
// So packs combine masks, where they would multiply registers full of zeros and ones.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program keep_bools(ir::Program program, Report& report);

}  // namespace rddlc::passes
