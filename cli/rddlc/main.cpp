// `rddlc`: an RDDL problem in, a simulator out.
#include "driver/codes.hpp"
#include "driver/driver.hpp"
#include "driver/explain.hpp"
#include "driver/files.hpp"
#include "driver/statistics.hpp"
#include "driver/version.hpp"
#include "options.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

namespace rddlc::cli {
namespace {

void print_times(const Compilation& compilation) {
    for (const StageTime& each : compilation.times) {
        fmt::print(stderr, "{:9} {:9.2f} ms\n", name_of(each.stage), each.time.count() * 1e3);
    }
}

void print_diagnostics(const Diagnostics& diagnostics, const Sources& sources,
                       const RenderOptions& options) {
    fmt::print(stderr, "{}", render(diagnostics, sources, options));
    const std::string counts = summary(diagnostics);
    const bool is_text = options.format == DiagnosticsFormat::Text;
    if (is_text && !counts.empty()) fmt::print(stderr, "{}\n", counts);
}

// To standard output, at once, so that a full disk shows.
ExitStatus write(std::string_view text, const Options& options) {
    const bool written =
        std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    if (written) return success;
    Diagnostics diagnostics;
    diagnostics.report(cannot_write("standard output", errno));
    print_diagnostics(diagnostics, {}, options.render);
    return diagnosed;
}

std::string statistics(const Compilation& compilation, Statistics format) {
    if (format == Statistics::None || !compilation.program) return "";
    return format == Statistics::Json ? statistics_json(compilation.passes)
                                      : statistics_text(compilation.passes);
}

ExitStatus run(const Options& options) {
    if (options.explained) return write(*explain(*options.explained), options);
    const Compilation compilation = compile(options.compile);
    const ExitStatus written =
        write(compilation.printed + statistics(compilation, options.statistics), options);
    print_diagnostics(compilation.diagnostics, compilation.sources, options.render);
    if (options.verbose) print_times(compilation);
    return compilation.diagnostics.has_errors() ? diagnosed : written;
}

}  // namespace
}  // namespace rddlc::cli

int main(int argc, char** argv) {
    using namespace rddlc;
    try {
        const auto [options, status] = cli::parse_command_line(argc, argv);
        if (!options) return status;
        return cli::run(*options);
    } catch (const std::exception& error) {
        fmt::print(stderr,
                   "rddlc: internal error: {}\n"
                   "This is a mistake in rddlc {}, not in your problem. Please report it with the "
                   "command and the files.\n",
                   error.what(), version);
        return cli::internal_error;
    }
}
