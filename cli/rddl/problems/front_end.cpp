#include "problems/front_end.hpp"

#include "support/failure.hpp"
#include "support/program.hpp"
#include "support/render.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace rddlc::cli {

namespace {

CompileOptions compile_options(const ProblemFiles& files, Stage last,
                               const std::vector<std::filesystem::path>& extern_headers) {
    CompileOptions options;
    options.extern_headers = extern_headers;
    options.inputs = files.inputs();
    options.policy = files.policy;
    options.stop_after = last;
    options.standard = files.standard;
    options.memory_limit = files.memory_limit;
    return options;
}

}  // namespace

Compilation compile_problem(const ProblemFiles& files, Stage last,
                            const std::vector<std::filesystem::path>& extern_headers,
                            const PassOptions& passes, RealType real) {
    CompileOptions options = compile_options(files, last, extern_headers);
    options.passes = passes;
    options.real = real;
    return compile(options);
}

Compilation check_problem(const ProblemFiles& files, Stage last,
                          const std::vector<std::filesystem::path>& extern_headers) {
    CompileOptions options = compile_options(files, last, extern_headers);
    options.domain_may_stand_alone = true;
    return compile(options);
}

void print_diagnostics(const Compilation& compilation) {
    RenderOptions options;
    options.color = tells_in_color();
    tell(render(compilation.diagnostics, compilation.sources, options));
    if (compilation.diagnostics.has_errors()) tell(closing_lines(compilation));
}

Compilation compile_or_give_up(const ProblemFiles& files, Stage last,
                               const std::vector<std::filesystem::path>& extern_headers,
                               const PassOptions& passes, RealType real) {
    Compilation compilation = compile_problem(files, last, extern_headers, passes, real);
    give_up_on_errors(compilation);
    return compilation;
}

void give_up_on_errors(const Compilation& compilation) {
    if (!compilation.diagnostics.has_errors()) return;
    print_diagnostics(compilation);
    throw Diagnosed{};
}

}  // namespace rddlc::cli
