// Values that a simulator takes to be finite.
//
// Passes leave out what is multiplied by zero where the other factor cannot be inf or nan: no step
// from the initial state makes it so, if actions are finite. A record that somebody else wrote may
// hold anything.
#pragma once

#include "engines/load_simulator.hpp"
#include "formats/records_json.hpp"
#include "problems/problem_lookup.hpp"

#include <cstddef>
#include <optional>
#include <set>
#include <string>

namespace rddlc::cli {

class FiniteValues {
  public:
    // The problem, which is known to load without errors by these options, is compiled when the
    // first value that is not finite comes.
    FiniteValues(ProblemFiles files, LoadOptions options);

    // What is wrong with a record of states or actions that was read: the first value that is not
    // finite and must be.
    std::optional<std::string> complaint(const RecordLayout& layout, const std::byte* record);

  private:
    bool may_be_infinite(const std::string& fluent);

    ProblemFiles files_;
    LoadOptions options_;
    std::optional<std::set<std::string>>
        infinite_;  // the fluents that may be inf or nan, once they are known
};

}  // namespace rddlc::cli
