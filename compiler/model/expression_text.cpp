#include "model/expression_text.hpp"

#include "support/match.hpp"

#include <fmt/format.h>

#include <span>

namespace rddlc::model {
namespace {

constexpr std::size_t line_width = 100;
constexpr int indent_width = 4;

// A piece of text that is set in one line if it fits, otherwise with each part on a line of its
// own: open part separator part close.
struct Layout {
    std::string open;
    std::vector<Layout> parts;
    std::string separator;
    std::string close;
};

Layout word(std::string text) {
    return {std::move(text), {}, "", ""};
}

void append_flat(const Layout& layout, std::string& out) {
    out += layout.open;
    for (std::size_t i = 0; i < layout.parts.size(); ++i) {
        if (i > 0) out += layout.separator;
        append_flat(layout.parts[i], out);
    }
    out += layout.close;
}

std::string_view trimmed(std::string_view text) {
    return text.substr(0, text.find_last_not_of(' ') + 1);
}

void begin_line(int indent, std::string& out) {
    out += '\n';
    out.append(static_cast<std::size_t>(indent), ' ');
}

void append(const Layout& layout, std::size_t room, int indent, std::string& out) {
    std::string flat;
    append_flat(layout, flat);
    if (layout.parts.empty() || flat.size() <= room) {
        out += flat;
        return;
    }
    const int inner = indent + indent_width;
    const std::size_t used = static_cast<std::size_t>(inner) + layout.separator.size();
    out += trimmed(layout.open);
    for (std::size_t i = 0; i < layout.parts.size(); ++i) {
        begin_line(inner, out);
        append(layout.parts[i], used < line_width ? line_width - used : 0, inner, out);
        if (i + 1 < layout.parts.size()) out += trimmed(layout.separator);
    }
    begin_line(indent, out);
    out += layout.close;
}

class ExpressionText {
  public:
    explicit ExpressionText(const Model& model) : model_(model) {}

    Layout of(const Expr& e) const {
        return match(
            e.node, [&](const Constant& n) { return word(text_of(model_, e.type, n.value)); },
            [&](const VariableValue& n) { return word(variable(n.variable)); },
            [&](const Reference& n) { return reference(n); },
            [&](const Convert& n) {
                return Layout{text_of(model_, e.type) + "(", {of(*n.operand)}, "", ")"};
            },
            [&](const TypeFault& n) {
                return word(fmt::format("fault<{}>(\"{}\")", text_of(model_, e.type), n.message));
            },
            [&](const Apply& n) { return apply(n); },
            [&](const If& n) {
                return Layout{
                    "if (", {of(*n.condition), of(*n.then_branch), of(*n.else_branch)}, ", ", ")"};
            },
            [&](const Switch& n) { return switch_(n); },
            [&](const Aggregate& n) {
                return Layout{fmt::format("{}_{{{}}} [", name_of(n.op),
                                          typed_variable_list(model_, n.variables)),
                              {of(*n.body)},
                              "",
                              "]"};
            },
            [&](const Sample& n) {
                return list(fmt::format("{}(", name_of(n.distribution)), n.parameters, ")");
            },
            [&](const Discrete& n) { return discrete(n); },
            [&](const DiscreteOver& n) {
                return Layout{fmt::format("{}_{{{}}} [", discrete_name(n.normalise),
                                          typed_variable_list(model_, {n.variable})),
                              {of(*n.weight)},
                              "",
                              "]"};
            },
            [&](const Determinant& n) {
                return Layout{
                    fmt::format("det_{{{}}} [", typed_variable_list(model_, {n.row, n.column})),
                    {of(*n.element)},
                    "",
                    "]"};
            },
            [&](const MatrixFunction& n) {
                return Layout{fmt::format("{}[row={}, col={}][", name_of(n.op), variable(n.row),
                                          variable(n.column)),
                              {of(*n.element)},
                              "",
                              "]"};
            },
            [&](const External& n) {
                return vectors(
                    fmt::format("${}[{}](", n.function, variable_list(model_, n.captured)),
                    n.arguments);
            },
            [&](const RandomVector& n) {
                return vectors(fmt::format("{}[{}](", name_of(n.distribution), variable(n.axis)),
                               n.arguments);
            });
    }

  private:
    std::string variable(VariableId id) const { return "?" + model_.variables[id].name; }

    std::string fluent(FluentId id, bool next) const {
        return model_.fluents[id].name + (next ? "'" : "");
    }

    static std::string_view discrete_name(bool normalise) {
        return normalise ? "UnnormDiscrete" : "Discrete";
    }

    Layout list(std::string open, std::span<const Expr> items, std::string close) const {
        Layout layout{std::move(open), {}, ", ", std::move(close)};
        for (const Expr& item : items) layout.parts.push_back(of(item));
        return layout;
    }

    Layout reference(const Reference& n) const {
        const std::string name = fluent(n.fluent, n.next);
        return n.arguments.empty() ? word(name) : list(name + "(", n.arguments, ")");
    }

    Layout apply(const Apply& n) const {
        const std::string source{source_name_of(n.op)};
        if (is_function(n.op)) return list(source + "[", n.operands, "]");
        if (n.operands.size() == 1) return list(source, n.operands, "");
        return {"(", {of(n.operands[0]), of(n.operands[1])}, " " + source + " ", ")"};
    }

    Layout switch_(const Switch& n) const {
        Layout layout{"switch (", {of(*n.subject)}, ", ", ")"};
        const std::vector<std::string>& members = model_.types[n.subject->type.type].objects;
        for (std::size_t i = 0; i < n.cases.size(); ++i)
            if (n.cases[i]) layout.parts.push_back(labelled("@" + members[i], **n.cases[i]));
        if (n.default_case) layout.parts.push_back(labelled("default", **n.default_case));
        return layout;
    }

    Layout discrete(const Discrete& n) const {
        const Type& type = model_.types[n.type];
        Layout layout{fmt::format("{}(", discrete_name(n.normalise)), {}, ", ", ")"};
        for (std::size_t i = 0; i < n.weights.size(); ++i)
            layout.parts.push_back(labelled("@" + type.objects[i], n.weights[i]));
        return layout;
    }

    Layout labelled(const std::string& label, const Expr& value) const {
        return {label + ": ", {of(value)}, "", ""};
    }

    Layout vectors(std::string open, const std::vector<VectorReference>& arguments) const {
        Layout layout{std::move(open), {}, ", ", ")"};
        for (const VectorReference& argument : arguments)
            layout.parts.push_back(word(vector(argument)));
        return layout;
    }

    std::string vector(const VectorReference& reference) const {
        std::string text = fluent(reference.fluent, reference.next);
        const std::vector<TypeId>& types = model_.fluents[reference.fluent].parameters;
        for (std::size_t i = 0; i < reference.slots.size(); ++i) {
            text += i == 0 ? "(" : ", ";
            text += match(
                reference.slots[i], [](const Axis&) { return std::string("_"); },
                [&](VariableId id) { return variable(id); },
                [&](std::int64_t object) {
                    return text_of(model_, ValueType{ValueType::Kind::Object, types[i]},
                                   Value{object});
                });
        }
        return reference.slots.empty() ? text : text + ")";
    }

    const Model& model_;
};

std::string variables_text(const Model& model, const std::vector<VariableId>& variables,
                           bool with_types) {
    std::string text;
    for (const VariableId id : variables) {
        const Variable& variable = model.variables[id];
        if (!text.empty()) text += ", ";
        text += "?" + variable.name;
        if (with_types) text += ": " + model.type_of(variable).name;
    }
    return text;
}

std::string text_of_real(double value) {
    const std::string text = fmt::format("{}", value);
    const bool looks_whole = text.find_first_not_of("-0123456789") == std::string::npos;
    return looks_whole ? text + ".0" : text;
}

}  // namespace

std::string text_of(const Model& model, ValueType type) {
    switch (type.kind) {
        case ValueType::Kind::Bool:
            return "bool";
        case ValueType::Kind::Int:
            return "int";
        case ValueType::Kind::Real:
            return "real";
        case ValueType::Kind::Object:
            break;
    }
    return model.types[type.type].name;
}

std::string text_of(const Model& model, ValueType type, const Value& value) {
    if (type.kind == ValueType::Kind::Object) {
        const Type& objects = model.types[type.type];
        const auto index = static_cast<std::size_t>(std::get<std::int64_t>(value));
        return (objects.enumerated ? "@" : "") + objects.objects[index];
    }
    return match(
        value, [](bool truth) { return std::string(truth ? "true" : "false"); },
        [](std::int64_t integer) { return std::to_string(integer); },
        [](double real) { return text_of_real(real); });
}

std::string variable_list(const Model& model, const std::vector<VariableId>& variables) {
    return variables_text(model, variables, false);
}

std::string typed_variable_list(const Model& model, const std::vector<VariableId>& variables) {
    return variables_text(model, variables, true);
}

std::string text_of(const Model& model, const Expr& expression, int indent) {
    std::string text;
    append(ExpressionText(model).of(expression), line_width - static_cast<std::size_t>(indent),
           indent, text);
    return text;
}

}  // namespace rddlc::model
