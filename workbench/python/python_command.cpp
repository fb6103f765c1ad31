#include "python/python_command.hpp"

#include "problems/front_end.hpp"
#include "support/files.hpp"

#include <cstdlib>
#include <filesystem>
#include <variant>

namespace rddlc::workbench {

std::string python_command(const std::string& named) {
    if (!named.empty()) return named;
    const char* const environment = std::getenv("VIRTUAL_ENV");
    return environment && *environment
               ? (std::filesystem::path(environment) / "bin/python").string()
               : "python3";
}

namespace {

// pyRDDLGym takes the last non-fluents, whatever the instance names: of several those are picked
// that belong to the instance. Empty if there is nothing to pick.
std::string instance_to_pick(const ProblemFiles& files) {
    if (!files.instance_name.empty()) return files.instance_name;
    std::string last;
    int blocks = 0;
    CompileOptions options = compile_options(files, Stage::Parse);
    options.extend = [&](ast::Program& tree, Sources&, Diagnostics&) {
        for (const ast::Block& block : tree.blocks) {
            if (std::holds_alternative<ast::NonFluents>(block)) ++blocks;
            if (const auto* instance = std::get_if<ast::Instance>(&block))
                last = instance->name.text;
        }
    };
    compile_or_give_up(options);
    return blocks > 1 ? last : "";
}

}  // namespace

PythonFiles files_for_python(const ProblemFiles& files, const std::filesystem::path& folder) {
    ProblemFiles picked = files;
    picked.instance_name = instance_to_pick(files);
    const bool is_chosen = !picked.instance_name.empty();
    if (files.instance && !is_chosen) return {files.domain, *files.instance};
    UsedFiles used;
    PythonFiles result{files.domain, folder / "no-instance.rddl"};
    write_file(result.instance, "", used);
    if (!is_chosen) return result;
    CompileOptions options = compile_options(picked, Stage::Parse);
    options.print = {Form::Ast};
    result.domain = folder / "problem.rddl";
    write_file(result.domain, compile_or_give_up(options).printed, used);
    return result;
}

}  // namespace rddlc::workbench
