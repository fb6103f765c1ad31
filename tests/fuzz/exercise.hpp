// A text through the whole compiler and some steps of what comes out: what all fuzzers run.
#pragma once

#include "contracts.hpp"

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::fuzzing {

// The compiler contradicts itself; the text says how.
class Contradiction : public std::logic_error {
  public:
    using std::logic_error::logic_error;
};

struct Exercise {
    PassOptions passes = {};
    Values values = Values::Tame;
    std::uint64_t seed = 1;
    int steps = 4;                 // at most; fewer where they are expensive
    double most_operations = 1e5;  // of a step; what costs more is compiled and not run
    bool all_stages = true;        // else no C++, and no syntax printed, for half of the time
};

enum class Outcome { Rejected, Accepted, TooLarge };

struct Exercised {
    Outcome outcome;
    std::string complaints = {};              // of what is rejected
    double operations = 0;                    // of one step
    std::map<std::string, int> changed = {};  // Contracts
    std::vector<Breach> breaches = {};
};

// Parses, checks, grounds, optimises and emits; holds every pass to its contract. Also expects that
// printed syntax reads back as the same tree. Throws Contradiction; every other exception or crash
// is also a bug. Problems that call external functions are compiled and not run; those with tables
// too large for a file are only grounded.
Exercised exercise(std::string_view text, const Exercise& how);

// The same; breaches are thrown.
Outcome exercise(std::string_view text, std::uint64_t seed, int steps);

}  // namespace rddlc::fuzzing
