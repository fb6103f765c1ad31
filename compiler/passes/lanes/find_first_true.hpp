// The object with the greatest of bools as numbers is the first one whose bool is true, or the
// first of all: the place of the lowest bit of a word.
//
//     for s in shape                                     for s in shape
//         drawn[s] = real(sample bernoulli@0[s](P))  =>      drawn[s] = sample bernoulli@0[s](P)
//     argmax[s in shape](drawn[s])                       place of the lowest of bits(drawn, 0)
//
// The place is the number of bits below it: those that differ in the word and the word less one.
// So numbers are not compared one after the other, and the bools may be drawn for several objects
// at once. Tables of such numbers that nothing else reads become tables of bools.
#pragma once

#include "ir/ir.hpp"
#include "passes/report.hpp"

namespace rddlc::passes {

ir::Program find_first_true(ir::Program program, Report& report);

}  // namespace rddlc::passes
