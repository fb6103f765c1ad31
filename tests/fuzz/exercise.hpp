// A text through the whole compiler and some steps of what comes out: what both fuzzers run.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace rddlc::fuzzing {

// The compiler contradicts itself; the text says how.
class Contradiction : public std::logic_error {
  public:
    using std::logic_error::logic_error;
};

enum class Outcome { Rejected, Accepted, TooLarge };

// Parses, checks, grounds, optimises and emits; steps the interpreter before and after optimisation
// under random actions. Expects that printed syntax reads back as the same, that the IR is valid,
// and that optimising changes no bit. Throws Contradiction; what else it throws or stops at is a
// bug, too. Problems of which a step costs too much to be worth it, or that call external
// functions, are compiled and not run; those with tables too large for a file are only grounded.
Outcome exercise(std::string_view text, std::uint64_t seed, int steps);

}  // namespace rddlc::fuzzing
