#include "front_end.hpp"

#include "failure.hpp"
#include "progress.hpp"
#include "support/render.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace rddlc::cli {

Compilation compile_problem(const ProblemFiles& files, Stage last) {
    CompileOptions options;
    options.inputs = files.all();
    options.stop_after = last;
    return compile(options);
}

void report(const Diagnostics& diagnostics, const Sources& sources) {
    RenderOptions options;
    options.color = is_terminal(2);
    fmt::print(stderr, "{}", render(diagnostics, sources, options));
    if (diagnostics.has_errors()) throw Diagnosed{};
}

Compilation compile_and_report(const ProblemFiles& files, Stage last) {
    Compilation compilation = compile_problem(files, last);
    report(compilation.diagnostics, compilation.sources);
    return compilation;
}

}  // namespace rddlc::cli
