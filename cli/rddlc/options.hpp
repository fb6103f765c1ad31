// The command line of rddlc.
#pragma once

#include "command_line/command_line.hpp"
#include "driver/driver.hpp"
#include "support/render.hpp"

#include <functional>
#include <string>

namespace rddlc::cli {

enum class Statistics { None, Text, Json };  // --stats

struct Options {
    CompileOptions compile;
    RenderOptions render;
    Statistics statistics = Statistics::None;
    bool verbose = false;
    std::string explanation;  // printed in place of compiling: --explain, --passes; else empty
};

// Its command line, which leads to `run` unless there is a mistake.
Command rddlc_command(std::function<ExitStatus(const Options&)> run);

}  // namespace rddlc::cli
