#include "formats/traced_problem.hpp"

#include "formats/trace.hpp"
#include "support/files.hpp"
#include "support/json_text.hpp"
#include "support/program.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <vector>

namespace rddlc::workbench {

ProblemFiles files_of_header(const std::string& line, const std::string& trace) {
    const Failure unknown(
        fmt::format("the first line of '{}' does not say which problem it is of", trace),
        "name the problem: rddl render TRACE DOMAIN INSTANCE");
    nlohmann::json header;
    try {
        header = parse_json(line);
    } catch (const RefusedJson&) {
        throw Failure(fmt::format("'{}' is not a trace: its first line is not JSON", trace),
                      "'rddl run --trace FILE' writes traces");
    }
    const auto files = header.is_object() ? header.find("files") : header.end();
    if (files == header.end() || !files->is_array() || files->empty()) throw unknown;
    std::vector<std::string> paths;
    for (const auto& file : *files) {
        if (!file.is_object() || !file.contains("path") || !file["path"].is_string()) throw unknown;
        paths.push_back(file["path"].get<std::string>());
    }
    for (const std::string& path : paths)
        if (!is_there(path))
            throw Failure(fmt::format("the trace is of '{}', which is not there", path),
                          "name the problem: rddl render TRACE DOMAIN INSTANCE");
    // A third one has the policy, of which states do not depend any more.
    ProblemFiles problem = find_files(paths[0], paths.size() > 1 ? paths[1] : "");
    for (const auto& file : changed_files(header, problem.inputs()))
        tell("rddl: warning: '{}' has changed since the trace was made\n", file.string());
    return problem;
}

}  // namespace rddlc::workbench
