// Shared parts of the tests of the passes: small problems, and the text before and after.
#pragma once

#include "passes/report.hpp"
#include "problem.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace rddlc {

// The buffers of a storage.
inline std::string names(const ir::Program& program, ir::Storage storage) {
    std::string text;
    for (const ir::Buffer& buffer : program.buffers) {
        if (buffer.storage == storage) text += (text.empty() ? "" : " ") + buffer.name;
    }
    return text;
}

// The line of a table whose printed name begins with this; empty if there is no such table.
inline std::string table_text(const ir::Program& program, const std::string& name) {
    const std::string text = ir::print(program);
    const std::size_t begin = text.find("    " + name);
    return begin == text.npos ? "" : text.substr(begin + 4, text.find('\n', begin) - begin - 4);
}

inline ir::Program valid(ir::Program program) {
    for (const std::string& complaint : ir::verify(program)) ADD_FAILURE() << complaint;
    return program;
}

// A problem with objects b1 to b3 of type "obj".
inline Problem with_tables(const std::string& cpf_of_x) {
    return {.pvariables =
                "SAME(obj) : { non-fluent, real, default = 1.5 };\n"
                "NONE(obj, obj) : { non-fluent, bool, default = false };\n"
                "W(obj) : { non-fluent, real, default = 1.0 };\n"
                "E(obj) : { non-fluent, int, default = -1 };\n"
                "x : { state-fluent, real, default = 0.0 };\n"
                "v(obj) : { state-fluent, real, default = 0.0 };\n"
                "p(obj) : { state-fluent, bool, default = false };",
            .cpfs = "x' = " + cpf_of_x + ";\nv'(?o) = v(?o);\np'(?o) = p(?o);",
            .non_fluents = "W(b2) = 4.0; E(b3) = 2;"};
}

// The right-hand side of the CPF of x, before and after a pass.
struct Texts {
    std::string before, after;
};
using Pass = ir::Program (*)(ir::Program, passes::Report&);
inline Texts of_x(ir::Program program, Pass pass) {
    const std::string before = value_of_x(program);
    passes::Report report;
    return {before, value_of_x(valid(pass(std::move(program), report)))};
}
inline Texts of_x(const std::string& cpf_of_x, Pass pass) {
    return of_x(grounded(with_tables(cpf_of_x)), pass);
}
// In the program for moderate values.
inline Texts of_moderate_x(const std::string& cpf_of_x, Pass pass) {
    return of_x(of_moderate_values(with_tables(cpf_of_x)), pass);
}

}  // namespace rddlc
