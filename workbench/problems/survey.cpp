#include "problems/survey.hpp"

#include "problems/front_end.hpp"
#include "terminal/parallel.hpp"

namespace rddlc::workbench {

std::vector<SurveyedProblem> survey(const std::vector<RepositoryProblem>& problems) {
    std::vector<SurveyedProblem> listed;
    for (const RepositoryProblem& problem : problems) listed.push_back({problem, std::nullopt});
    for_each_with_progress("looking at problems", listed.size(), [&](std::size_t i) {
        const RepositoryProblem& problem = listed[i].problem;
        if (problem.instances.empty()) return;
        const Compilation compilation = compile(
            compile_options(find_instance(problem, problem.instances.front()), Stage::Check));
        if (compilation.model) listed[i].characteristics = characteristics_of(*compilation.model);
    });
    return listed;
}

}  // namespace rddlc::workbench
