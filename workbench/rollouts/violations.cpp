#include "rollouts/violations.hpp"

#include "engines/external_library.hpp"
#include "ir/layout.hpp"
#include "problems/front_end.hpp"
#include "rollouts/explain_condition.hpp"
#include "support/failure.hpp"
#include "support/render.hpp"

#include <fmt/format.h>

#include <utility>

namespace rddlc::workbench {

const char* fate_of_illegal_actions(Preconditions preconditions) {
    switch (preconditions) {
        case Preconditions::Ignore:
        case Preconditions::Warn:
            return "taken nevertheless";
        case Preconditions::Error:
            return "refused";
        case Preconditions::Noop:
            return "replaced by the default action";
    }
    return "";
}

std::string ViolationText::line() const {
    return fmt::format("{}: {}: {}{}{}", place, what, condition, explanation.empty() ? "" : " ",
                       explanation);
}

std::string ViolationText::diagnostic(const std::string& severity, const std::string& when) const {
    return fmt::format("{}: {}: {}{}\n{}", place, severity, what, when, excerpt) +
           (explanation.empty() ? "" : fmt::format("note: {}\n", explanation));
}

// The problem after the stage `ground`.
struct ViolationExplainer::Problem {
    Problem(Compilation compilation, const ProblemFiles& files, const LoadOptions& options)
        : sources(std::move(compilation.sources)),
          program(*std::move(compilation.program)),
          library(external_library(program, files, options)),
          evaluator(program, library.functions) {}
    Problem(const Problem&) = delete;
    Problem& operator=(const Problem&) = delete;

    bool has(const Violation& violation) const {
        return ir::record_layout(program, ir::Storage::State).size == violation.state.size() &&
               ir::record_layout(program, ir::Storage::Action).size == violation.action.size();
    }
    ViolationText explain(const std::vector<ir::Computation>& conditions, const char* what,
                          const Violation& violation) const;

    Sources sources;
    ir::Program program;
    ExternalLibrary library;
    ir::Evaluator evaluator;
};

ViolationText ViolationExplainer::Problem::explain(const std::vector<ir::Computation>& conditions,
                                                   const char* what,
                                                   const Violation& violation) const {
    const ir::Records records = ir::Records()
                                    .set(ir::Storage::State, violation.state.data())
                                    .set(ir::Storage::Action, violation.action.data());
    if (has(violation))
        for (const ir::Computation& condition : conditions)
            if (const auto explanation =
                    explain_condition(program, evaluator, condition, records, violation.context))
                return {sources.location(condition.span), what,
                        sources.text_on_one_line(condition.span), explanation->text(),
                        source_excerpt(sources, condition.span)};
    throw Failure("the files of the problem have changed since it was loaded");
}

ViolationExplainer::ViolationExplainer(ProblemFiles files, LoadOptions options)
    : files_(std::move(files)), options_(std::move(options)) {}
ViolationExplainer::~ViolationExplainer() = default;

const ViolationExplainer::Problem& ViolationExplainer::problem() {
    if (!problem_)
        problem_ = std::make_unique<const Problem>(
            compile_or_give_up(compile_options(files_, Stage::Verify)), files_, options_);
    return *problem_;
}

ViolationText ViolationExplainer::precondition(const Violation& violation) {
    return problem().explain(problem().program.preconditions, "precondition violated", violation);
}

ViolationText ViolationExplainer::invariant(const Violation& violation) {
    return problem().explain(problem().program.invariants, "state invariant violated", violation);
}

}  // namespace rddlc::workbench
