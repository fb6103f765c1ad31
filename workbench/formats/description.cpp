#include "formats/description.hpp"

#include "autodiff/straight_line.hpp"
#include "engines/interpreted_simulator.hpp"
#include "problems/front_end.hpp"

#include <optional>
#include <string>
#include <utility>

namespace rddlc::workbench {

ProblemDescription describe(const ProblemFiles& files) {
    Compilation compilation = compile_or_give_up(compile_options(files, Stage::Optimise));
    ProblemDescription description;
    description.files = files;
    description.model = *std::move(compilation.model);
    description.characteristics = characteristics_of(description.model);
    const std::optional<std::string> no_derivatives = autodiff::refusal_of(*compilation.program);
    description.simulator =
        interpreted_simulator(*std::move(compilation.program), std::move(compilation.sources));
    description.refusals = solvers::refusals(*description.simulator, no_derivatives);
    return description;
}

}  // namespace rddlc::workbench
