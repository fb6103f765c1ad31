#include "problems/check_many.hpp"

#include "problems/front_end.hpp"
#include "terminal/parallel.hpp"

#include <set>
#include <string_view>

namespace rddlc::workbench {

namespace {

CheckOutcome check_quietly(const ProblemFiles& files) {
    const Compilation compilation = compile(check_options(files, Stage::Ground));
    return {true, render_each(compilation.diagnostics, compilation.sources)};
}

}  // namespace

std::vector<CheckOutcome> check_many(const std::vector<ProblemFiles>& files) {
    std::vector<CheckOutcome> outcomes(files.size());
    for_each_with_progress("checking", files.size(),
                           [&](std::size_t i) { outcomes[i] = check_quietly(files[i]); });
    return outcomes;
}

CheckedInstances::CheckedInstances(std::span<const CheckOutcome> outcomes) {
    std::set<std::string_view> seen;
    for (const CheckOutcome& outcome : outcomes) {
        instances += outcome.done;
        without_errors += outcome.done && !outcome.has_errors();
        for (const RenderedDiagnostic& each : outcome.diagnostics) {
            if (!seen.insert(each.text).second) continue;
            (each.is_error ? errors : warnings) += 1;
            different.push_back(&each);
        }
    }
}

void CheckedInstances::add(const CheckedInstances& others) {
    instances += others.instances;
    without_errors += others.without_errors;
    errors += others.errors;
    warnings += others.warnings;
    different.insert(different.end(), others.different.begin(), others.different.end());
}

}  // namespace rddlc::workbench
