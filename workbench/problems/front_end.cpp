#include "problems/front_end.hpp"

#include "support/failure.hpp"
#include "support/program.hpp"
#include "support/render.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace rddlc::workbench {

CompileOptions compile_options(const ProblemFiles& files, Stage last) {
    CompileOptions options;
    options.inputs = files.inputs();
    options.policy = files.policy;
    options.instance = files.instance_name;
    options.stop_after = last;
    options.standard = files.standard;
    options.memory_limit = files.memory_limit;
    return options;
}

CompileOptions check_options(const ProblemFiles& files, Stage last) {
    CompileOptions options = compile_options(files, last);
    options.domain_may_stand_alone = true;
    return options;
}

void print_diagnostics(const Compilation& compilation) {
    RenderOptions options;
    options.color = tells_in_color();
    tell_with_codes(render(compilation.diagnostics, compilation.sources, options));
    if (compilation.diagnostics.has_errors()) tell(closing_lines(compilation, "rddl"));
}

void print_policy_warnings(const Compilation& compilation, const ProblemFiles& files) {
    if (!files.policy) return;
    Diagnostics warnings;
    for (const Diagnostic& each : compilation.diagnostics.all())
        if (each.span && compilation.sources[each.span->file].path() == files.policy->string())
            warnings.report(each);
    if (warnings.all().empty()) return;
    RenderOptions options;
    options.color = tells_in_color();
    tell_with_codes(render(warnings, compilation.sources, options));
}

Compilation compile_or_give_up(const CompileOptions& options) {
    Compilation compilation = compile(options);
    give_up_on_errors(compilation);
    return compilation;
}

void give_up_on_errors(const Compilation& compilation) {
    if (!compilation.diagnostics.has_errors()) return;
    print_diagnostics(compilation);
    throw Diagnosed{};
}

}  // namespace rddlc::workbench
