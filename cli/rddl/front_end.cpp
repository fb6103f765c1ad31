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

void print_diagnostics(const Compilation& compilation) {
    RenderOptions options;
    options.color = is_terminal(2);
    fmt::print(stderr, "{}", render(compilation.diagnostics, compilation.sources, options));
}

Compilation compile_or_give_up(const ProblemFiles& files, Stage last) {
    Compilation compilation = compile_problem(files, last);
    if (!compilation.diagnostics.has_errors()) return compilation;
    print_diagnostics(compilation);
    throw Diagnosed{};
}

}  // namespace rddlc::cli
