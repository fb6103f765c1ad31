#include "formats/unified_diff.hpp"

#include "driver/process.hpp"
#include "driver/work_folder.hpp"
#include "support/failure.hpp"
#include "support/files.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <optional>

namespace rddlc::workbench {

std::string unified_diff(const std::string& name, const std::string& before,
                         const std::string& after) {
    if (before == after) return "";
    const TemporaryFolder folder;
    const auto written = [&](const char* file, const std::string& text) {
        UsedFiles used;
        write_file(folder.path() / file, text, used);
        return (folder.path() / file).string();
    };
    // Labels are written -L by all of them: GNU, BSD and busybox.
    const std::optional<ProcessResult> result = run_process(
        {"diff", "-u", "-L", name, "-L", name, written("before", before), written("after", after)},
        {"LC_ALL=C"});
    if (!result)
        throw Failure(fmt::format("cannot run 'diff': {}", std::strerror(errno)),
                      "install it (the package diffutils)");
    constexpr int they_differ = 1;
    if (result->status != they_differ) throw Failure("'diff' fails: " + result->output);
    if (result->output.size() >= most_process_output)
        throw Failure("the difference is too long to show",
                      "--check says only whether there is one");
    return result->output;
}

}  // namespace rddlc::workbench
