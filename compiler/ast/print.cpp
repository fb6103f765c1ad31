#include "ast/print.hpp"

#include "support/match.hpp"
#include "support/writer.hpp"

#include <fmt/format.h>

namespace rddlc::ast {

namespace {

constexpr std::size_t expression_width = 80;

std::string names(const std::vector<Name>& names, std::string_view mark = "") {
    std::string text;
    for (const Name& name : names)
        text.append(text.empty() ? "" : ", ").append(mark).append(name.text);
    return text;
}

// "(a, b)", or nothing for an empty list.
std::string parameters(const std::vector<Name>& list, std::string_view mark = "") {
    return list.empty() ? "" : fmt::format("({})", names(list, mark));
}

std::string symbol(const Symbol& symbol) {
    return (symbol.at_sign ? "@" : "") + symbol.name;
}

std::string constant(const Constant& constant) {
    return match(
        constant.value, [](const Boolean& b) { return std::string(b.value ? "true" : "false"); },
        [](const Integer& i) { return std::to_string(i.value); },
        [](const Real& r) { return r.text; }, [](const PosInf&) { return std::string("pos-inf"); },
        [](const NegInf&) { return std::string("neg-inf"); },
        [](const Symbol& s) { return symbol(s); });
}

std::string type_declaration(const TypeDeclaration& declaration) {
    if (!declaration.members) return fmt::format("{} : object;", declaration.name.text);
    return fmt::format("{} : {{{}}};", declaration.name.text, names(*declaration.members, "@"));
}

std::string pvariable(const PVariable& p) {
    std::string text = fmt::format("{}{}{} : {{ {}, {}", p.name.text, p.primed ? "'" : "",
                                   parameters(p.parameters), p.kind.text, p.range.text);
    if (p.default_value) text += ", default = " + constant(*p.default_value);
    if (p.level) text += ", level = " + constant(*p.level);
    return text + " };";
}

std::string assignment(const Assignment& a) {
    std::string text = (a.negated ? "~" : "") + a.name.text;
    for (std::size_t i = 0; i < a.arguments.size(); ++i)
        text.append(i == 0 ? "(" : ", ").append(symbol(a.arguments[i]));
    if (!a.arguments.empty()) text += ")";
    if (!a.value) return text + ";";
    const std::string value = match(
        *a.value, [](const Constant& c) { return constant(c); },
        [](const ExprBox& e) { return print(*e); });
    return fmt::format("{} = {};", text, value);
}

std::string_view keyword(ConstraintKind kind) {
    switch (kind) {
        case ConstraintKind::Termination:
            return "termination";
        case ConstraintKind::ActionPreconditions:
            return "action-preconditions";
        case ConstraintKind::StateActionConstraints:
            return "state-action-constraints";
        case ConstraintKind::StateInvariants:
            break;
    }
    return "state-invariants";
}

class Printer {
  public:
    void print(const Block& block) {
        match(
            block, [&](const Domain& b) { print_block("domain", b.name, b.sections); },
            [&](const NonFluents& b) { print_block("non-fluents", b.name, b.sections); },
            [&](const Instance& b) { print_block("instance", b.name, b.sections); },
            [&](const Policy& b) { print_block("policy", b.name, b.sections); });
    }

    std::string text() && { return std::move(writer_).text(); }

  private:
    template <class Section>
    void print_block(std::string_view keyword, const Name& name,
                     const std::vector<Section>& sections) {
        writer_.block(fmt::format("{} {} {{", keyword, name.text), "}", [&] {
            for (const Section& section : sections)
                match(section.node, [&](const auto& node) { print(node); });
        });
    }

    template <class Item, class PrintItem>
    void print_section(std::string_view keyword, const std::vector<Item>& items,
                       PrintItem print_item) {
        writer_.block(fmt::format("{} {{", keyword), "};", [&] {
            for (const Item& item : items) writer_.line(print_item(item));
        });
    }

    void print(const Requirements& r) {
        writer_.line(fmt::format("requirements = {{{}}};", names(r.names)));
    }
    void print(const Types& t) { print_section("types", t.declarations, type_declaration); }
    void print(const PVariables& p) { print_section("pvariables", p.declarations, pvariable); }
    void print(const Cpfs& c) {
        writer_.block(c.keyword.text + " {", "};", [&] {
            for (const Cpf& cpf : c.definitions) print(cpf);
        });
    }
    void print(const Cpf& cpf) {
        print_equation(fmt::format("{}{}{} =", cpf.name.text, cpf.primed ? "'" : "",
                                   parameters(cpf.parameters, "?")),
                       cpf.body);
    }
    void print(const Reward& reward) { print_equation("reward =", reward.value); }
    void print(const Constraints& c) {
        print_section(keyword(c.kind), c.conditions, [](const Expr& condition) {
            return print_wrapped(condition, expression_width) + ";";
        });
    }

    // "left body;", with the body on lines of its own when it needs several.
    void print_equation(const std::string& left, const Expr& body) {
        const std::string right = print_wrapped(body, expression_width);
        if (right.find('\n') == std::string::npos)
            writer_.line(fmt::format("{} {};", left, right));
        else
            writer_.line(left).indent().line(right + ";").dedent();
    }

    void print(const DomainName& d) { writer_.line(fmt::format("domain = {};", d.name.text)); }
    void print(const NonFluentsName& n) {
        writer_.line(fmt::format("non-fluents = {};", n.name.text));
    }
    void print(const Objects& o) {
        print_section("objects", o.lists, [](const ObjectList& objects) {
            return fmt::format("{} : {{{}}};", objects.type.text, names(objects.objects));
        });
    }
    void print(const NonFluentValues& v) {
        print_section("non-fluents", v.assignments, assignment);
    }
    void print(const InitState& s) { print_section("init-state", s.assignments, assignment); }
    void print(const MaxNondefActions& m) {
        writer_.line(fmt::format("max-nondef-actions = {};",
                                 m.value ? std::to_string(*m.value) : "pos-inf"));
    }
    void print(const Horizon& horizon) {
        match(
            horizon.value,
            [&](const Integer& i) { writer_.line(fmt::format("horizon = {};", i.value)); },
            [&](const PosInf&) { writer_.line("horizon = pos-inf;"); },
            [&](const Expr& e) {
                writer_.line(fmt::format("horizon = terminate-when ({});", ast::print(e)));
            });
    }
    void print(const Discount& d) {
        const std::string value = match(
            d.value, [](const Integer& i) { return std::to_string(i.value); },
            [](const Real& r) { return r.text; });
        writer_.line(fmt::format("discount = {};", value));
    }

    Writer writer_;
};

}  // namespace

std::string print(const Program& program) {
    Printer printer;
    for (const Block& block : program.blocks) printer.print(block);
    return std::move(printer).text();
}

}  // namespace rddlc::ast
