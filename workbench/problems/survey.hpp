// Many problems at a glance.
#pragma once

#include "problems/characteristics.hpp"
#include "problems/problem_lookup.hpp"

#include <optional>
#include <vector>

namespace rddlc::workbench {

// A problem with its characteristics, taken from one instance; instances hardly differ in them.
struct SurveyedProblem {
    RepositoryProblem problem;
    std::optional<Characteristics> characteristics;  // absent if there are errors
};

// In parallel, with a progress bar.
std::vector<SurveyedProblem> survey(const std::vector<RepositoryProblem>& problems);

}  // namespace rddlc::workbench
