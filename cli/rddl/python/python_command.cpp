#include "python/python_command.hpp"

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

}  // namespace rddlc::cli
