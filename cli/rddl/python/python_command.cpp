#include "python/python_command.hpp"

#include "problems/front_end.hpp"
#include "support/files.hpp"

#include <cstdlib>
#include <filesystem>

namespace rddlc::cli {

std::string python_command(const std::string& named) {
    if (!named.empty()) return named;
    const char* const environment = std::getenv("VIRTUAL_ENV");
    return environment && *environment
               ? (std::filesystem::path(environment) / "bin/python").string()
               : "python3";
}

PythonFiles files_for_python(const ProblemFiles& files, const std::filesystem::path& folder) {
    const bool is_chosen = !files.instance_name.empty();
    if (files.instance && !is_chosen) return {files.domain, *files.instance};
    UsedFiles used;
    PythonFiles result{files.domain, folder / "no-instance.rddl"};
    write_file(result.instance, "", used);
    if (!is_chosen) return result;
    CompileOptions options = compile_options(files, Stage::Parse);
    options.print = {Form::Ast};
    result.domain = folder / "problem.rddl";
    write_file(result.domain, compile_or_give_up(options).printed, used);
    return result;
}

}  // namespace rddlc::cli
