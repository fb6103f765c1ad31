#include "python/python_command.hpp"

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

std::filesystem::path instance_for_python(const ProblemFiles& files,
                                          const std::filesystem::path& folder) {
    if (files.instance) return *files.instance;
    const std::filesystem::path empty = folder / "no-instance.rddl";
    UsedFiles used;
    write_file(empty, "", used);
    return empty;
}

}  // namespace rddlc::cli
