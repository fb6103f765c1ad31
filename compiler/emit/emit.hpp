// IR -> one C++ file. Decides spelling, nothing else: what the file computes and in which order is
// written in the program. docs/emitted-code.md is a guided tour of the result.
#pragma once

#include "ir/details.hpp"
#include "ir/ir.hpp"
#include "support/source.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rddlc {

struct EmitOptions {
    // Header: everything inline, for one #include; no exported C function.
    bool header = false;
    // The function that the text exports; empty: rddl_simulator_<domain>_<instance>.
    std::string entry = "";
    // #line before every statement, so that debuggers and profilers show the RDDL text.
    bool line_directives = false;
    // Environments that a step of a batch computes at once (8, 16, 32 or 64; 1: no packs).
    int lane_count = 16;
    // Where registers hold 64 ints of a byte, a step computes as many environments at once, with
    // such ints (passes/arithmetic/byte_ints.hpp).
    bool byte_ints = false;
    // The name under which the text will be stored, for what comes after the last #line.
    std::string output_name = "simulator.cpp";
    std::string compiler_version = "";  // of rddlc
    // The headers that define the external functions, as #include finds them.
    std::vector<std::string> extern_headers = {};
};

// The whole text, formatted. `program` must be verified. `details` are of the same problem, or
// null.
std::string emit(const ir::Program& program, const Sources& sources, const EmitOptions& options,
                 const ir::Details* details = nullptr);

// A header for C and C++ that declares the function which the text exports.
std::string emit_declaration(const ir::Program& program, const EmitOptions& options);

// Whether a function of C and C++ can have this name.
bool can_be_entry(std::string_view name);

// A file that exports the external functions that the program calls as rddl/external.h has it:
// what the interpreter loads.
std::string emit_external_library(const ir::Program& program,
                                  const std::vector<std::string>& headers);
// The C function of an external function in a shared object: "rddl_extern_inflow".
std::string external_entry(std::string_view name);
// The type of the C++ function that a call needs: "double(std::span<const double, 3>)".
std::string external_signature(const ir::Program& program, const ir::Call& call);

}  // namespace rddlc
