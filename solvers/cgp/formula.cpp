// Over 400 lines: one formula in five languages, side by side.
#include "solvers/cgp/formula.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rddlc::solvers {

namespace {

using Term = Formula::Term;

std::string number(double value) {
    return fmt::format("{:.6g}", value);
}

bool is_atom(const Term& term) {
    return term.kind != Term::Kind::Function || info_of(term.function).arity == 0;
}

// How tightly a text holds together, from a choice to a name: where something tighter is needed, it
// gets brackets.
enum Tightness : int {
    choice,
    either,
    both,
    negation,
    comparison,
    sum,
    product,
    sign,
    power,
    name
};

// How tightly a function binds and what it needs of its arguments: (a + b) + c is "a + b + c", and
// a + (b + c) keeps its brackets, since it rounds differently.
struct Binding {
    Tightness own = name;
    std::array<Tightness, 3> needed{choice, choice, choice};
};

Binding binding_for_people(Function function) {
    switch (function) {
        case Function::Add:
        case Function::Subtract:
            return {sum, {sum, product}};
        case Function::Multiply:
        case Function::Divide:
            return {product, {product, sign}};
        case Function::Half:
            return {product, {product}};
        case Function::Negate:
            return {sign, {power}};
        case Function::Square:
            return {power, {name}};
        case Function::Greater:
            return {comparison, {sum, sum}};
        case Function::Not:
            return {negation, {name}};
        case Function::And:
            return {both, {both, both}};
        case Function::Or:
            return {either, {either, either}};
        case Function::If:
            return {choice, {sum, either, choice}};
        case Function::Absolute:
        case Function::Minimum:
        case Function::Maximum:
        case Function::Root:
        case Function::Sine:
        case Function::Cosine:
        case Function::Tanh:
        case Function::Exponential:
        case Function::Sign:
        case Function::One:
        case Function::Zero:
        case Function::Floor:
        case Function::Ceiling:
        case Function::Round:
        case Function::HalfSum:
        case Function::HalfDistance:
        case Function::ScaledExponential:
        case Function::ScaledLength:
        case Function::AbsolutePower:
        case Function::ArcSine:
        case Function::ArcCosine:
        case Function::ArcTangent:
            break;  // name(...)
    }
    return {};
}

struct Text {
    std::string words;
    Tightness tightness = name;
};

// How a language writes things.
struct Language {
    // The text of input number i, as the program reads it.
    std::function<Text(int)> input;
    std::function<std::string(double)> constant;
    // The text of a call; arguments are bracketed where they need it.
    std::function<std::string(Function, const std::string&, const std::string&, const std::string&)>
        call;
    std::function<Binding(Function)> binding = [](Function) {
        return Binding{};
    };
    std::string shared = "v{}";  // names of parts that occur several times
};

struct Written {
    std::vector<std::pair<std::string, std::string>> parts;  // name, text
    std::vector<std::string> outputs;
};

Written write(const Formula& formula, const Language& language) {
    std::vector<int> uses(formula.terms.size());
    for (const Term& term : formula.terms)
        for (const int argument : term.arguments)
            if (argument >= 0) uses[static_cast<std::size_t>(argument)] += 1;
    for (const int output : formula.outputs) uses[static_cast<std::size_t>(output)] += 1;

    Written written;
    std::vector<Text> texts;
    for (std::size_t t = 0; t < formula.terms.size(); ++t) {
        const Term& term = formula.terms[t];
        Text text;
        if (term.kind == Term::Kind::Input) {
            text = language.input(term.input);
        } else if (term.kind == Term::Kind::Constant) {
            text = {language.constant(term.constant), term.constant < 0 ? sign : name};
        } else {
            const Binding binding = language.binding(term.function);
            const auto argument = [&](std::size_t k) -> std::string {
                if (term.arguments[k] < 0) return "";
                const Text& its = texts[static_cast<std::size_t>(term.arguments[k])];
                return its.tightness < binding.needed[k] ? "(" + its.words + ")" : its.words;
            };
            text = {language.call(term.function, argument(0), argument(1), argument(2)),
                    binding.own};
        }
        if (uses[t] > 1 && !is_atom(term)) {
            const std::string shared =
                fmt::format(fmt::runtime(language.shared), written.parts.size() + 1);
            written.parts.emplace_back(shared, text.words);
            text = {shared, name};
        }
        texts.push_back(text);
    }
    for (const int output : formula.outputs)
        written.outputs.push_back(texts[static_cast<std::size_t>(output)].words);
    return written;
}

// (x - shift) * scale, without what changes nothing.
Text scaled(const ProgramInput& input, const std::string& variable) {
    // Names of several words, such as sums over objects, that no bracket ends.
    const bool is_long = variable.find(' ') != std::string::npos && variable.back() != ')';
    Text text{variable, is_long ? choice : name};
    if (input.shift > 0) text = {fmt::format("{} - {}", variable, number(input.shift)), sum};
    if (input.shift < 0) text = {fmt::format("{} + {}", variable, number(-input.shift)), sum};
    if (input.scale == 1) return text;
    if (input.shift != 0) text.words = "(" + text.words + ")";
    return {fmt::format("{} * {}", text.words, number(input.scale)), product};
}

// A plus or minus b, where b may be a negative number, or -x, itself.
std::string added(const std::string& a, char plus_or_minus, const std::string& b) {
    const bool is_negative = b.starts_with('-') && b.find(' ') == std::string::npos;
    if (!is_negative) return fmt::format("{} {} {}", a, plus_or_minus, b);
    return fmt::format("{} {} {}", a, plus_or_minus == '+' ? '-' : '+', b.substr(1));
}

Language for_people(const ProgramScope& scope) {
    Language language;
    language.input = [&scope](int i) {
        const ProgramInput& input = scope.inputs[static_cast<std::size_t>(i)];
        return scaled(input, input.name);
    };
    language.constant = number;
    language.binding = binding_for_people;
    language.call = [](Function function, const std::string& a, const std::string& b,
                       const std::string& c) -> std::string {
        if (function == Function::Add) return added(a, '+', b);
        if (function == Function::Subtract) return added(a, '-', b);
        if (function == Function::Multiply) return a + " * " + b;
        if (function == Function::Divide) return a + " / " + b;
        if (function == Function::Negate) return "-" + a;
        if (function == Function::Square) return a + "^2";
        if (function == Function::Half) return a + " / 2";
        if (function == Function::Greater) return a + " > " + b;
        if (function == Function::And) return a + " and " + b;
        if (function == Function::Or) return a + " or " + b;
        if (function == Function::Not) return "not " + a;
        if (function == Function::If) return "if " + a + " > 0 then " + b + " else " + c;
        const FunctionInfo& info = info_of(function);
        return info.arity == 1 ? fmt::format("{}({})", info.name, a)
                               : fmt::format("{}({}, {})", info.name, a, b);
    };
    return language;
}

// The group to which the bool belongs, or NULL.
const CategoryHead* group_of(const ActionSpace& space, int column) {
    for (const CategoryHead& head : space.categories)
        if (std::ranges::binary_search(head.group, column)) return &head;
    return nullptr;
}

// How many values besides the default can be chosen for a bool, an object or an int.
int other_values(const ActionSpace& space, int column) {
    for (const CategoryHead& head : space.categories)
        if (head.column == column) return head.count - 1;
    return static_cast<int>(
        std::count_if(space.choices.begin(), space.choices.end(),
                      [column](const Choice& choice) { return choice.column == column; }));
}

// How an output becomes an action, where that is not clear.
std::string meaning_of(const ProgramScope& scope, std::size_t output) {
    const ActionSpace& space = scope.actions;
    int column = static_cast<int>(output);
    if (scope.lifted)
        for (const ProgramScope::Unit& unit : scope.units)
            if (unit.output == static_cast<int>(output)) {
                column = unit.column;
                break;
            }
    for (const RealHead& head : space.reals) {
        if (head.column != column) continue;
        switch (head.range) {
            case RealHead::Range::Squashed:  // of PPO alone
            case RealHead::Range::Bounded:
                if (head.lower == -1 && head.upper == 1) return "";
                return fmt::format("   [-1 is {}, 1 is {}]", number(head.lower),
                                   number(head.upper));
            case RealHead::Range::AboveLower:
                return fmt::format("   [x is {} + {} * ln(1 + e^x)]", number(head.lower),
                                   number(head.scale));
            case RealHead::Range::BelowUpper:
                return fmt::format("   [x is {} - {} * ln(1 + e^x)]", number(head.upper),
                                   number(head.scale));
            case RealHead::Range::Free:
                return fmt::format("   [x is {} + {} * x]", number(head.centre),
                                   number(head.scale));
        }
    }
    if (const CategoryHead* const group = group_of(space, column))
        return fmt::format("   [of those that exclude each other the greatest{} is done]",
                           group->first_value == 0 ? " above 0" : "");
    const int others = other_values(space, column);
    if (space.max_sub_actions == 0)
        return others == 1
                   ? "   [above 0 is true]"
                   : fmt::format("   [x from -1 to 1 in {} equal parts, a value each]", others + 1);
    const std::string which = others == 1 ? "above 0" : "|x|";
    const std::string value =
        others == 1 ? "" : fmt::format("; x from -1 to 1 in {} equal parts, a value each", others);
    return space.max_sub_actions == 1 ? fmt::format("   [the greatest {} is done{}]", which, value)
                                      : fmt::format("   [the greatest {} are done, at most {}{}]",
                                                    which, space.max_sub_actions, value);
}

std::string identifier(const std::string& name) {
    std::string result;
    for (const char c : name) result += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return result;
}

Language for_cpp() {
    Language language;
    language.input = [](int i) {
        return Text{fmt::format("x[{}]", i)};
    };
    language.constant = [](double value) {
        return fmt::format("{:.17g}", value) +
               (value == std::floor(value) && std::abs(value) < 1e15 ? ".0" : "");
    };
    language.call = [](Function function, const std::string& a, const std::string& b,
                       const std::string& c) {
        const FunctionInfo& info = info_of(function);
        return info.arity == 0   ? std::string(function == Function::One ? "1.0" : "0.0")
               : info.arity == 1 ? fmt::format("f::{}({})", identifier(info.name) + "_", a)
               : info.arity == 2
                   ? fmt::format("f::{}({}, {})", identifier(info.name) + "_", a, b)
                   : fmt::format("f::{}({}, {}, {})", identifier(info.name) + "_", a, b, c);
    };
    return language;
}

}  // namespace

std::string formula_text(const Formula& formula, const ProgramScope& scope) {
    const Written written = write(formula, for_people(scope));
    std::string text;
    for (const auto& [name, part] : written.parts) text += fmt::format("{} = {}\n", name, part);
    for (std::size_t o = 0; o < written.outputs.size(); ++o)
        text +=
            fmt::format("{} = {}{}\n", scope.outputs[o], written.outputs[o], meaning_of(scope, o));
    return text;
}

std::string short_formula(const Formula& formula, const ProgramScope& scope, std::size_t width) {
    const Written written = write(formula, for_people(scope));
    std::string text;
    for (std::size_t o = 0; o < written.outputs.size(); ++o)
        text += (o > 0 ? "; " : "") + scope.outputs[o] + " = " + written.outputs[o];
    for (const auto& [name, part] : written.parts) text += fmt::format("; {} = {}", name, part);
    return text.size() > width ? text.substr(0, width - 3) + "..." : text;
}

std::string formula_cpp(const Formula& formula, const ProgramScope& scope) {
    const Written written = write(formula, for_cpp());
    std::string text =
        "// A policy that rddl train cgp has found; rddl export wrote it.\n"
        "// Inputs are values of fluents as the simulator observes them; outputs what the comments "
        "say.\n"
        "#pragma once\n\n#include <cmath>\n\nnamespace policy {\n\nnamespace f {\n"
        "inline double in_range(double x) {\n"
        "    return x != x ? 0 : x > 1e6 ? 1e6 : x < -1e6 ? -1e6 : x;\n}\n"
        "inline double add_(double a, double b) { return in_range(a + b); }\n"
        "inline double sub_(double a, double b) { return in_range(a - b); }\n"
        "inline double mul_(double a, double b) { return in_range(a * b); }\n"
        "inline double div_(double a, double b) { return std::abs(b) < 1e-9 ? 1 : in_range(a / b); "
        "}\n"
        "inline double neg_(double a) { return -a; }\n"
        "inline double abs_(double a) { return std::abs(a); }\n"
        "inline double min_(double a, double b) { return b < a ? b : a; }\n"
        "inline double max_(double a, double b) { return a < b ? b : a; }\n"
        "inline double square_(double a) { return in_range(a * a); }\n"
        "inline double sqrt_(double a) { return std::sqrt(std::abs(a)); }\n"
        "inline double sin_(double a) { return std::sin(a); }\n"
        "inline double cos_(double a) { return std::cos(a); }\n"
        "inline double tanh_(double a) { return std::tanh(a); }\n"
        "inline double exp_(double a) { return in_range(std::exp(a)); }\n"
        "inline double gt_(double a, double b) { return a > b; }\n"
        "inline double if_(double a, double b, double c) { return a > 0 ? b : c; }\n"
        "inline double and_(double a, double b) { return a > 0 && b > 0; }\n"
        "inline double or_(double a, double b) { return a > 0 || b > 0; }\n"
        "inline double not_(double a) { return !(a > 0); }\n"
        "inline double sign_(double a) { return a > 0 ? 1 : a < 0 ? -1 : 0; }\n"
        "inline double half_(double a) { return a * 0.5; }\n"
        "inline double floor_(double a) { return std::floor(a); }\n"
        "inline double ceil_(double a) { return std::ceil(a); }\n"
        "inline double round_(double a) { return std::nearbyint(a); }\n"
        "constexpr double pi = 3.14159265358979323846;\n"
        "inline double in_unit(double x) { return x > 1 ? 1 : x < -1 ? -1 : x; }\n"
        "inline double halfsum_(double a, double b) { return in_range(0.5 * (a + b)); }\n"
        "inline double halfdist_(double a, double b) { return in_range(0.5 * std::abs(a - b)); }\n"
        "inline double uexp_(double a) {\n"
        "    return in_range((std::exp(a) - 1) / (std::exp(1.0) - 1));\n}\n"
        "inline double ulength_(double a, double b) {\n"
        "    return in_range(std::sqrt(a * a + b * b) / std::sqrt(2.0));\n}\n"
        "inline double upow_(double a, double b) {\n"
        "    return in_range(std::pow(std::abs(a), std::abs(b)));\n}\n"
        "inline double uasin_(double a) { return 2 * std::asin(in_unit(a)) / pi; }\n"
        "inline double uacos_(double a) { return std::acos(in_unit(a)) / pi; }\n"
        "inline double uatan_(double a) { return 4 * std::atan(a) / pi; }\n"
        "}  // namespace f\n\n";
    text += fmt::format("constexpr int input_count = {}, output_count = {};\n\n",
                        scope.input_count(), scope.output_count());
    text += "inline void act(const double* inputs, double* outputs) {\n";
    text += fmt::format("    double x[{}];\n", std::max(scope.input_count(), 1));
    for (int i = 0; i < scope.input_count(); ++i) {
        const ProgramInput& input = scope.inputs[static_cast<std::size_t>(i)];
        text += fmt::format("    x[{0}] = (inputs[{0}] - {1:.17g}) * {2:.17g};  // {3}\n", i,
                            input.shift, input.scale, input.name);
    }
    for (const auto& [name, part] : written.parts)
        text += fmt::format("    const double {} = {};\n", name, part);
    for (std::size_t o = 0; o < written.outputs.size(); ++o)
        text += fmt::format("    outputs[{}] = {};  // {}{}\n", o, written.outputs[o],
                            scope.outputs[o], meaning_of(scope, o));
    return text + "}\n\n}  // namespace policy\n";
}

std::string formula_python(const Formula& formula, const ProgramScope& scope) {
    Language language = for_cpp();
    language.call = [](Function function, const std::string& a, const std::string& b,
                       const std::string& c) {
        const FunctionInfo& info = info_of(function);
        return info.arity == 0   ? std::string(function == Function::One ? "1.0" : "0.0")
               : info.arity == 1 ? fmt::format("_{}({})", info.name, a)
               : info.arity == 2 ? fmt::format("_{}({}, {})", info.name, a, b)
                                 : fmt::format("_{}({}, {}, {})", info.name, a, b, c);
    };
    const Written written = write(formula, language);
    std::string text =
        "\"\"\"A policy that rddl train cgp has found; rddl export wrote it.\"\"\"\n"
        "import math\n\n\n"
        "def _in_range(x): return 0.0 if x != x else max(-1e6, min(1e6, x))\n"
        "def _add(a, b): return _in_range(a + b)\n"
        "def _sub(a, b): return _in_range(a - b)\n"
        "def _mul(a, b): return _in_range(a * b)\n"
        "def _div(a, b): return 1.0 if abs(b) < 1e-9 else _in_range(a / b)\n"
        "def _neg(a): return -a\n"
        "def _abs(a): return abs(a)\n"
        "def _min(a, b): return min(a, b)\n"
        "def _max(a, b): return max(a, b)\n"
        "def _square(a): return _in_range(a * a)\n"
        "def _sqrt(a): return math.sqrt(abs(a))\n"
        "def _sin(a): return math.sin(a)\n"
        "def _cos(a): return math.cos(a)\n"
        "def _tanh(a): return math.tanh(a)\n"
        "def _exp(a): return 1e6 if a > 14 else _in_range(math.exp(a))\n"
        "def _gt(a, b): return float(a > b)\n"
        "def _if(a, b, c): return b if a > 0 else c\n"
        "def _and(a, b): return float(a > 0 and b > 0)\n"
        "def _or(a, b): return float(a > 0 or b > 0)\n"
        "def _not(a): return float(not a > 0)\n"
        "def _sign(a): return float((a > 0) - (a < 0))\n"
        "def _half(a): return a * 0.5\n"
        "def _floor(a): return float(math.floor(a))\n"
        "def _ceil(a): return float(math.ceil(a))\n"
        "def _round(a): return float(round(a))\n"
        "def _halfsum(a, b): return _in_range(0.5 * (a + b))\n"
        "def _halfdist(a, b): return _in_range(0.5 * abs(a - b))\n"
        "def _uexp(a): return 1e6 if a > 15 else _in_range((math.exp(a) - 1) / (math.e - 1))\n"
        "def _ulength(a, b): return _in_range(math.sqrt(a * a + b * b) / math.sqrt(2))\n"
        "def _upow(a, b):\n"
        "    try: return _in_range(abs(a) ** abs(b))\n"
        "    except OverflowError: return 1e6\n"
        "def _uasin(a): return 2 * math.asin(max(-1.0, min(1.0, a))) / math.pi\n"
        "def _uacos(a): return math.acos(max(-1.0, min(1.0, a))) / math.pi\n"
        "def _uatan(a): return 4 * math.atan(a) / math.pi\n\n\n";
    text += "INPUTS = [";
    for (const ProgramInput& input : scope.inputs) text += fmt::format("\"{}\", ", input.name);
    text += "]\nOUTPUTS = [";
    for (const std::string& output : scope.outputs) text += fmt::format("\"{}\", ", output);
    text +=
        "]\n\n\ndef act(inputs):\n    \"\"\"Outputs in their order, from inputs in theirs.\"\"\"\n "
        "   x = [";
    for (int i = 0; i < scope.input_count(); ++i) {
        const ProgramInput& input = scope.inputs[static_cast<std::size_t>(i)];
        text += fmt::format("(inputs[{}] - {:.17g}) * {:.17g}, ", i, input.shift, input.scale);
    }
    text += "]\n";
    for (const auto& [name, part] : written.parts) text += fmt::format("    {} = {}\n", name, part);
    text += "    return [";
    for (const std::string& output : written.outputs) text += output + ", ";
    return text + "]\n";
}

std::string formula_latex(const Formula& formula, const ProgramScope& scope) {
    const auto escaped = [](const std::string& name) {
        std::string text;
        for (const char c : name)
            text += (c == '_' || c == '%' || c == '&' || c == '#' ? "\\" : "") + std::string(1, c);
        return "\\text{" + text + "}";
    };
    Language language = for_people(scope);
    language.shared = "v_{{{}}}";
    language.input = [&](int i) {
        const ProgramInput& input = scope.inputs[static_cast<std::size_t>(i)];
        return scaled(input, escaped(input.name));
    };
    // Fractions, roots and the like hold together what is in them.
    language.binding = [](Function function) -> Binding {
        if (function == Function::Divide) return {power};
        if (function == Function::Greater) return {name, {sum, sum}};
        if (function == Function::If) return {choice, {sum}};
        return binding_for_people(function);
    };
    const auto people = language.call;
    language.call = [people](Function function, const std::string& a, const std::string& b,
                             const std::string& c) -> std::string {
        if (function == Function::Multiply) return a + " \\cdot " + b;
        if (function == Function::Divide) return "\\frac{" + a + "}{" + b + "}";
        if (function == Function::Absolute) return "\\left|" + a + "\\right|";
        if (function == Function::Root) return "\\sqrt{\\left|" + a + "\\right|}";
        if (function == Function::And) return a + " \\wedge " + b;
        if (function == Function::Or) return a + " \\vee " + b;
        if (function == Function::Not) return "\\neg " + a;
        if (function == Function::Greater) return "[" + a + " > " + b + "]";
        if (function == Function::If)
            return "\\begin{cases} " + b + " & " + a + " > 0 \\\\ " + c +
                   " & \\text{else} \\end{cases}";
        if (function == Function::Sine || function == Function::Cosine ||
            function == Function::Tanh || function == Function::Exponential ||
            function == Function::Minimum || function == Function::Maximum)
            return "\\" + people(function, a, b, c);
        return people(function, a, b, c);
    };
    const Written written = write(formula, language);
    std::string text = "\\begin{align*}\n";
    for (const auto& [name, part] : written.parts) text += name + " &= " + part + " \\\\\n";
    for (std::size_t o = 0; o < written.outputs.size(); ++o)
        text += escaped(scope.outputs[o]) + " &= " + written.outputs[o] + " \\\\\n";
    return text + "\\end{align*}\n";
}

std::string formula_dot(const Formula& formula, const ProgramScope& scope) {
    std::string text = "digraph policy {\n    rankdir=LR;\n    node [fontname=\"sans-serif\"];\n";
    for (std::size_t t = 0; t < formula.terms.size(); ++t) {
        const Term& term = formula.terms[t];
        const std::string label =
            term.kind == Term::Kind::Input
                ? input_label(scope.inputs[static_cast<std::size_t>(term.input)])
            : term.kind == Term::Kind::Constant ? number(term.constant)
                                                : std::string(info_of(term.function).name);
        const char* const shape = term.kind == Term::Kind::Function ? "ellipse" : "box";
        text += fmt::format("    t{} [label=\"{}\", shape={}];\n", t, label, shape);
        for (std::size_t k = 0; k < 3; ++k)
            if (term.arguments[k] >= 0)
                text += fmt::format("    t{} -> t{} [label=\"{}\"];\n", term.arguments[k], t,
                                    info_of(term.function).arity > 1 ? std::to_string(k + 1) : "");
    }
    for (std::size_t o = 0; o < formula.outputs.size(); ++o)
        text += fmt::format("    o{0} [label=\"{1}\", shape=box, style=bold];\n    t{2} -> o{0};\n",
                            o, scope.outputs[o], formula.outputs[o]);
    return text + "}\n";
}

}  // namespace rddlc::solvers
