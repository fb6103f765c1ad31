#include "formats/description.hpp"

#include "autodiff/straight_line.hpp"
#include "engines/interpreted_simulator.hpp"
#include "problems/front_end.hpp"

#include <optional>
#include <string>
#include <utility>

namespace rddlc::workbench {

namespace {

// Passes add and fold functions of whole tables, and derivatives are taken before them.
std::optional<std::string> why_no_derivatives(const ProblemFiles& files) {
    return autodiff::refusal_of(*compile_or_give_up(compile_options(files, Stage::Verify)).program);
}

}  // namespace

ProblemDescription describe(const ProblemFiles& files) {
    Compilation compilation = compile_or_give_up(compile_options(files, Stage::Optimise));
    ProblemDescription description;
    description.files = files;
    description.model = *std::move(compilation.model);
    description.characteristics = characteristics_of(description.model);
    description.simulator =
        interpreted_simulator(*std::move(compilation.program), std::move(compilation.sources));
    description.refusals = solvers::refusals(*description.simulator, why_no_derivatives(files));
    return description;
}

}  // namespace rddlc::workbench
