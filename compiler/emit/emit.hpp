// IR -> one C++ file. Decides spelling, nothing else: what the file computes and in which order is
// written in the program. docs/emitted-code.md is a guided tour of the result.
#pragma once

#include "ir/ir.hpp"
#include "support/source.hpp"

#include <string>

namespace rddlc {

struct EmitOptions {
    // Header: everything inline, for one #include; no exported C function.
    bool header = false;
    // #line before every statement, so that debuggers and profilers show the RDDL text.
    bool line_directives = false;
    // The name under which the text will be stored, for what comes after the last #line.
    std::string output_name = "simulator.cpp";
    std::string compiler_version = "";  // of rddlc
};

// The whole text, formatted. `program` must be verified.
std::string emit(const ir::Program& program, const Sources& sources, const EmitOptions& options);

}  // namespace rddlc
