#include "front_end.hpp"

#include "check/check.hpp"
#include "failure.hpp"
#include "ground/ground.hpp"
#include "parse/parse.hpp"
#include "passes/passes.hpp"
#include "progress.hpp"
#include "support/render.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

namespace rddlc::cli {

CheckedProblem check_problem(const ProblemFiles& files) {
    CheckedProblem problem{files, {}, Diagnostics{}, std::nullopt};
    std::vector<FileId> ids;
    for (const auto& path : files.all()) {
        const auto id = problem.sources.load(path);
        if (!id)
            throw Failure(fmt::format("cannot read '{}': {}", path.string(), std::strerror(errno)));
        ids.push_back(*id);
    }
    const ast::Program program = parse(problem.sources, ids, problem.diagnostics);
    if (problem.diagnostics.has_errors()) return problem;
    problem.model = check(program, problem.sources, problem.diagnostics);
    return problem;
}

void report(const CheckedProblem& problem) {
    const RenderOptions options{.color = is_terminal(2)};
    fmt::print(stderr, "{}", render(problem.diagnostics, problem.sources, options));
    if (problem.diagnostics.has_errors()) throw Diagnosed{};
}

ir::Program ground_problem(CheckedProblem& problem) {
    auto program = ground(*problem.model, problem.diagnostics);
    if (!program) report(problem);
    return optimise(*std::move(program));
}

}  // namespace rddlc::cli
