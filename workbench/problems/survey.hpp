// Many problems at a glance.
#pragma once

#include "problems/characteristics.hpp"
#include "problems/problem_lookup.hpp"

#include <optional>
#include <vector>

namespace rddlc::workbench {

// What one instance shows of a problem; instances hardly differ in it.
struct SurveyedProblem {
    RepositoryProblem problem;
    std::optional<Characteristics> characteristics;  // absent if there are errors
};

// In parallel, with a progress bar.
std::vector<SurveyedProblem> survey(const std::vector<RepositoryProblem>& problems);

}  // namespace rddlc::workbench
