// Violated preconditions and invariants: how to treat them, and how to report them.
#pragma once

#include "engines/load_simulator.hpp"
#include "problems/problem_lookup.hpp"
#include "solvers/evaluation/preconditions.hpp"

#include <memory>
#include <string>

namespace rddlc::workbench {

using solvers::Preconditions;
using solvers::Violation;

// "refused"
const char* fate_of_illegal_actions(Preconditions preconditions);

struct ViolationText {
    std::string place;        // "reservoir.rddl:52:9"
    std::string what;         // "precondition violated"
    std::string condition;    // as written, on one line
    std::string explanation;  // "at ?r = t2: release(t2) = 30.5, rlevel(t2) = 12.25"
    std::string excerpt;      // the source line and the caret below it

    // "PLACE: WHAT: CONDITION EXPLANATION"
    std::string line() const;
    // The text in the form of the compiler's warnings and errors; `when` follows the message.
    std::string diagnostic(const std::string& severity, const std::string& when) const;
};

// Evaluates violated conditions again, slowly, and explains them.
class ViolationExplainer {
  public:
    // The problem, which is known to load without errors by these options, is compiled when the
    // first violation comes.
    ViolationExplainer(ProblemFiles files, LoadOptions options);
    ~ViolationExplainer();

    // Explains the first condition that is violated. Throws Failure if all hold, since the files
    // have changed.
    ViolationText precondition(const Violation& violation);
    ViolationText invariant(const Violation& violation);

  private:
    struct Problem;
    const Problem& problem();

    ProblemFiles files_;
    LoadOptions options_;
    std::unique_ptr<const Problem> problem_;
};

}  // namespace rddlc::workbench
