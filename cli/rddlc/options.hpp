// The command line of rddlc.
#pragma once

#include "driver/driver.hpp"
#include "support/failure.hpp"
#include "support/render.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rddlc::cli {

enum class Statistics { None, Text, Json };  // --stats

struct Options {
    CompileOptions compile;
    RenderOptions render;
    Statistics statistics = Statistics::None;
    bool verbose = false;
    std::optional<Code> explained;  // --explain
};

// The options, or the exit status where there is nothing left to do: after --help, --version, or a
// mistake that has been reported.
struct CommandLine {
    std::optional<Options> options;
    ExitStatus status = success;
};
CommandLine parse_command_line(int argc, char** argv);

}  // namespace rddlc::cli
