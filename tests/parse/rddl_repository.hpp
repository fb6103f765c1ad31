// The place of rddlrepository for tests that read all of it.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace rddlc {

// The folder in RDDL_REPOSITORY, or that of the installed Python package; empty if there is
// neither.
inline std::filesystem::path rddl_repository() {
    if (const char* folder = std::getenv("RDDL_REPOSITORY")) return folder;
    std::string text;
    constexpr auto command =
        "python3 -c 'import rddlrepository; print(rddlrepository.__path__[0])' 2>/dev/null";
    if (FILE* pipe = popen(command, "r")) {
        for (int c = fgetc(pipe); c != EOF && c != '\n'; c = fgetc(pipe))
            text += static_cast<char>(c);
        pclose(pipe);
    }
    return text;
}

}  // namespace rddlc
