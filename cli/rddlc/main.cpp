// `rddlc`: an RDDL problem in, a simulator out.
#include "driver/driver.hpp"
#include "driver/statistics.hpp"
#include "driver/version.hpp"
#include "options.hpp"
#include "support/program.hpp"

#include <fmt/format.h>

#include <string>

namespace rddlc::cli {
namespace {

void print_times(const Compilation& compilation) {
    for (const StageTime& each : compilation.times) {
        tell("{:9} {:9.2f} ms\n", name_of(each.stage), each.time.count() * 1e3);
    }
}

void print_diagnostics(const Compilation& compilation, const RenderOptions& options) {
    tell_with_codes(render(compilation.diagnostics, compilation.sources, options));
    if (options.format == DiagnosticsFormat::Text) tell(closing_lines(compilation, "rddlc"));
}

std::string statistics(const Compilation& compilation, Statistics format) {
    if (format == Statistics::None || !compilation.program) return "";
    return format == Statistics::Json ? statistics_json(compilation.passes)
                                      : statistics_text(compilation.passes);
}

ExitStatus run(const Options& options) {
    if (!options.explanation.empty()) {
        print("{}", options.explanation);
        return success;
    }
    const Compilation compilation = compile(options.compile);
    print_data(compilation.printed);
    print(statistics(compilation, options.statistics));
    print_diagnostics(compilation, options.render);
    if (options.verbose) print_times(compilation);
    return compilation.diagnostics.has_errors() ? diagnosed : success;
}

}  // namespace
}  // namespace rddlc::cli

int main(int argc, char** argv) {
    using namespace rddlc;
    return run_program("rddlc", version, [&] {
        return cli::run_command_line(cli::rddlc_command(cli::run), version, argc, argv);
    });
}
