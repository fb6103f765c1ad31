// RDDL text -> IR, for tests.
#pragma once

#include "check/check.hpp"
#include "ground/ground.hpp"
#include "ir/print.hpp"
#include "ir/verify.hpp"
#include "parse/parse.hpp"
#include "support/diagnostic.hpp"
#include "support/render.hpp"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace rddlc {

// The parts of a problem that tests vary. There are objects a1 and a2 of type "one-or-two", b1 to
// b3 of type "obj", and an enumerated type "color" of @red, @green and @blue.
struct Problem {
    std::string pvariables;
    std::string cpfs;
    std::string reward = "0";
    std::string blocks = {};       // of the domain: action-preconditions { ... }; and the like
    std::string non_fluents = {};  // p(b1) = 3;
    std::string init_state = {};

    std::string text() const {
        const auto section = [](const std::string& name, const std::string& body) {
            return body.empty() ? "" : name + " {\n" + body + "\n};\n";
        };
        return "domain d {\n"
               "types { obj : object; pair : object; color : {@red, @green, @blue}; };\n"
               "pvariables {\n" +
               pvariables + "\n};\ncpfs {\n" + cpfs + "\n};\nreward = " + reward + ";\n" + blocks +
               "\n}\n"
               "non-fluents n {\n domain = d;\n"
               " objects { obj : {b1, b2, b3}; pair : {a1, a2}; };\n" +
               section("non-fluents", non_fluents) +
               "}\n"
               "instance i {\n domain = d; non-fluents = n;\n" +
               section("init-state", init_state) +
               " max-nondef-actions = pos-inf; horizon = 10; discount = 1.0;\n}\n";
    }
};

struct Grounded {
    std::optional<ir::Program> program;
    std::string messages;
    std::string codes;  // "E0601 E0603", in the order of reporting
};

inline Grounded ground_text(const std::string& text) {
    Sources sources;
    Diagnostics diagnostics;
    const std::array files = {sources.add("test.rddl", text)};
    const ast::Program ast = parse(sources, files, diagnostics);
    Grounded result;
    if (!diagnostics.has_errors()) {
        const std::optional<model::Model> model = check(ast, sources, diagnostics);
        if (model && !diagnostics.has_errors()) result.program = ground(*model, diagnostics);
    }
    result.messages = render(diagnostics, sources, {});
    for (const Diagnostic& diagnostic : diagnostics.all()) {
        result.codes += (result.codes.empty() ? "" : " ") + to_string(diagnostic.code);
    }
    return result;
}

// Grounds a problem that has no errors.
inline ir::Program grounded(const Problem& problem) {
    Grounded result = ground_text(problem.text());
    if (!result.program) throw std::runtime_error(result.messages);
    for (const std::string& complaint : ir::verify(*result.program)) ADD_FAILURE() << complaint;
    return std::move(*result.program);
}

// The same with objects b1 to b20 of type "obj".
inline ir::Program grounded_with_many(std::string text) {
    const std::string few = "obj : {b1, b2, b3}";
    std::string many = "obj : {b1";
    for (int i = 2; i <= 20; ++i) many += ", b" + std::to_string(i);
    Grounded result = ground_text(text.replace(text.find(few), few.size(), many + "}"));
    if (!result.program) throw std::runtime_error(result.messages);
    return std::move(*result.program);
}

inline ir::Program grounded_with_many(const Problem& problem) {
    return grounded_with_many(problem.text());
}

// The program for moderate values alone, if there is one.
inline ir::Program of_moderate_values(const Problem& problem) {
    ir::Program program = grounded(problem);
    return program.moderate ? std::move(**program.moderate) : program;
}

// The lines of the printed step, without the indentation of the block.
inline std::string step_text(const ir::Program& program) {
    const std::string text = ir::print(program);
    const std::size_t begin = text.find("\nstep\n") + 6;
    std::string step = text.substr(begin, text.find("\n\n", begin) + 1 - begin);
    std::string result;
    for (std::size_t line = 0; line < step.size();) {
        const std::size_t end = step.find('\n', line) + 1;
        result += step.substr(line + 4, end - line - 4);
        line = end;
    }
    return result;
}

// The right-hand side of the CPF of the real state-fluent x of a problem with some usual fluents.
inline Problem usual_problem(const std::string& cpf_of_x) {
    return {.pvariables =
                "R(obj) : { non-fluent, real, default = 1.0 };\n"
                "B(obj, pair) : { non-fluent, bool, default = false };\n"
                "K : { non-fluent, int, default = 4 };\n"
                "x : { state-fluent, real, default = 2.0 };\n"
                "n : { state-fluent, int, default = 3 };\n"
                "v(obj) : { state-fluent, real, default = 1.0 };\n"
                "p(obj) : { state-fluent, bool, default = false };\n"
                "c : { state-fluent, color, default = @red };\n"
                "near(obj) : { state-fluent, color, default = @green };\n"
                "q(color) : { state-fluent, real, default = 0.5 };\n"
                "a(obj) : { action-fluent, bool, default = false };\n"
                "f : { action-fluent, real, default = 0.0 };",
            .cpfs = "x' = " + cpf_of_x +
                    ";\nn' = n;\nv'(?o) = v(?o);\np'(?o) = p(?o);\nc' = c;\n"
                    "near'(?o) = near(?o);\nq'(?k) = q(?k);",
            .non_fluents = "R(b2) = 2.5; B(b1, a2);"};
}

inline std::string value_of_x(const ir::Program& program) {
    const std::string step = step_text(program);
    const std::string start = "next.x = ";
    const std::size_t begin = step.find(start) + start.size();
    return step.substr(begin, step.find('\n', begin) - begin);
}

inline std::string lowered(const std::string& expression) {
    return value_of_x(grounded(usual_problem(expression)));
}

}  // namespace rddlc
