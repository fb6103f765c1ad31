// From a problem's files to the checked model and the program, diagnostics printed on the way.
#pragma once

#include "ir/ir.hpp"
#include "model/model.hpp"
#include "problem_lookup.hpp"
#include "support/diagnostic.hpp"
#include "support/source.hpp"

#include <memory>

namespace rddlc::cli {

struct CheckedProblem {
    ProblemFiles files;
    Sources sources;
    Diagnostics diagnostics;
    std::optional<model::Model> model;  // absent: there are errors
};

// Reads and checks; prints nothing.
CheckedProblem check_problem(const ProblemFiles& files);

// Prints all diagnostics on stderr; throws Diagnosed if there are errors.
void report(const CheckedProblem& problem);

// The optimised program of a problem without errors. Reports what is not supported yet and throws
// Diagnosed.
ir::Program ground_problem(CheckedProblem& problem);

}  // namespace rddlc::cli
