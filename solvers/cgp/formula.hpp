// Programs as formulas: simplified, and written for readers and for other programs.
#pragma once

#include "solvers/cgp/genome.hpp"
#include "solvers/cgp/scope.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace rddlc::solvers {

// Terms share parts: each is made once, and only of those before it.
struct Formula {
    struct Term {
        enum class Kind : std::uint8_t { Input, Constant, Function } kind = Kind::Constant;
        int input = 0;
        double constant = 0;
        Function function = Function::Zero;
        std::array<int, 3> arguments{-1, -1, -1};
        auto operator<=>(const Term&) const = default;
    };
    std::vector<Term> terms;
    std::vector<int> outputs;

    // How many functions there are.
    int size() const;
    std::vector<double> evaluate(const std::vector<double>& inputs) const;
};

// The formula has the same values as the genome's program where inputs are within +-1e6.
Formula simplified(const Genome& genome);

// "action = vel > pos", a line for each output; parts that occur several times have lines of their
// own.
std::string formula_text(const Formula& formula, const ProgramScope& scope);
// The formula in one line, cut if it would be longer than `width`.
std::string short_formula(const Formula& formula, const ProgramScope& scope, std::size_t width);
// A C++ header with a function that writes outputs from inputs; needs nothing but <cmath>.
std::string formula_cpp(const Formula& formula, const ProgramScope& scope);
// A graph for Graphviz.
std::string formula_dot(const Formula& formula, const ProgramScope& scope);
// "(pos - 0.85) * 0.4878": an input as the program reads it.
std::string input_label(const ProgramInput& input);
// A picture: functions are round, arguments arrive from above to below in their order.
std::string formula_svg(const Formula& formula, const ProgramScope& scope);
// A Python module with the same function.
std::string formula_python(const Formula& formula, const ProgramScope& scope);
// \begin{align*}
std::string formula_latex(const Formula& formula, const ProgramScope& scope);

}  // namespace rddlc::solvers
