// Over 400 lines: a function for each form of the IR.
#include "ir/print.hpp"

#include "ir/call.hpp"
#include "support/match.hpp"
#include "support/writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <functional>

namespace rddlc::ir {
namespace {

constexpr std::size_t printed_values = 12;

// How tightly an expression holds together, as in C++.
enum Precedence {
    or_level,
    and_level,
    equality_level,
    order_level,
    sum_level,
    product_level,
    unary_level,
    primary_level
};

struct Infix {
    std::string_view symbol;
    Precedence level;
};

std::optional<Infix> infix_of(Operator op) {
    struct Row {
        Operator op;
        Infix infix;
    };
    constexpr Row rows[] = {
        {Operator::Add, {"+", sum_level}},
        {Operator::Subtract, {"-", sum_level}},
        {Operator::Multiply, {"*", product_level}},
        {Operator::Divide, {"/", product_level}},
        {Operator::Equal, {"==", equality_level}},
        {Operator::Equivalent, {"==", equality_level}},
        {Operator::NotEqual, {"!=", equality_level}},
        {Operator::Less, {"<", order_level}},
        {Operator::LessEqual, {"<=", order_level}},
        {Operator::Greater, {">", order_level}},
        {Operator::GreaterEqual, {">=", order_level}},
        {Operator::And, {"&&", and_level}},
        {Operator::Or, {"||", or_level}},
    };
    const auto* row = std::ranges::find(rows, op, &Row::op);
    return row == std::end(rows) ? std::nullopt : std::optional(row->infix);
}

std::optional<std::string_view> prefix_of(Operator op) {
    if (op == Operator::Not) return "!";
    if (op == Operator::Negate) return "-";
    return std::nullopt;
}

std::string_view name_of(Scalar scalar) {
    constexpr std::string_view names[] = {"bool", "int", "real"};
    return names[static_cast<std::size_t>(scalar)];
}

std::string_view name_of(Storage storage) {
    constexpr std::string_view names[] = {"constant", "state",       "action", "scratch",
                                          "next",     "observation", "memory", "next_memory"};
    return names[static_cast<std::size_t>(storage)];
}

std::string text_of(const Value& value) {
    return match(
        value, [](bool v) { return std::string(v ? "true" : "false"); },
        [](std::int64_t v) { return fmt::format("{}", v); },
        [](double v) {
            std::string text = fmt::format("{}", v);
            const bool whole = text.find_first_not_of("-0123456789") == std::string::npos;
            return whole ? text + ".0" : text;
        });
}

std::string lower_case(std::string_view name) {
    std::string text(name);
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

class Printer {
  public:
    explicit Printer(const Program& program) : program_(program) {}

    std::string expression(NodeId id) const { return expression(id, or_level); }

    std::string whole_program() && {
        writer_.line(fmt::format("program {} {}", program_.domain_name, program_.instance_name));
        types();
        for (Storage storage :
             {Storage::Constant, Storage::State, Storage::Action, Storage::Scratch, Storage::Next,
              Storage::Observation, Storage::Memory, Storage::NextMemory}) {
            buffers(storage);
        }
        bounds();
        if (!program_.reset.empty()) definitions("reset", program_.reset);
        definitions("step", program_.step);
        writer_.line();
        computation("reward", program_.reward);
        conditions("precondition", program_.preconditions);
        conditions("invariant", program_.invariants);
        conditions("termination", program_.terminations);
        if (program_.policy) policy(*program_.policy);
        sites();
        return std::move(writer_).text();
    }

  private:
    void definitions(const char* name, const std::vector<Definition>& definitions) {
        writer_.line().line(name).indent();
        for (const Definition& definition : definitions) {
            if (definition.unchosen) unchosen(*definition.unchosen);
            block(definition.body);
        }
        writer_.dedent();
    }

    // "state.seen unless action.use or action.move"; "unread unless ..."
    void unchosen(const Unchosen& form) {
        std::vector<std::string> choices;
        for (const BufferId choice : form.choices) choices.push_back(element(choice, {}));
        writer_.line(fmt::format("{} unless {}", form.kept ? element(*form.kept, {}) : "unread",
                                 fmt::join(choices, " or ")));
    }

    // ------------------------------------------------------------------------- tables

    void types() {
        if (program_.types.empty()) return;
        writer_.line().line("types").indent();
        for (const ObjectType& type : program_.types) {
            writer_.line(fmt::format("{}: {}", type.name, shortened(type.objects)));
        }
        writer_.dedent();
    }

    static std::string shortened(const std::vector<std::string>& words) {
        if (words.size() <= printed_values) return fmt::format("{}", fmt::join(words, " "));
        const std::vector head(words.begin(), words.begin() + printed_values);
        return fmt::format("{} ... ({})", fmt::join(head, " "), words.size());
    }

    void buffers(Storage storage) {
        const auto belongs = [&](const Buffer& buffer) {
            return buffer.storage == storage;
        };
        if (std::ranges::none_of(program_.buffers, belongs)) return;
        writer_.line().line(name_of(storage)).indent();
        for (const Buffer& buffer : program_.buffers) {
            if (belongs(buffer)) writer_.line(declaration(buffer));
        }
        writer_.dedent();
    }

    std::string declaration(const Buffer& buffer) const {
        std::string text = buffer.name;
        if (!buffer.types.empty()) {
            std::vector<std::string_view> names;
            for (std::uint32_t type : buffer.types) names.push_back(program_.types[type].name);
            text += fmt::format("[{}]", fmt::join(names, ", "));
        } else if (!buffer.shape.empty()) {
            text += fmt::format("[{}]", fmt::join(buffer.shape, ", "));
        }
        text += fmt::format(": {}", name_of(buffer.scalar));
        if (!buffer.values.empty()) text += " = " + values(buffer.values);
        return text;
    }

    // One for all where they are equal.
    static std::string values(const Table& values) {
        if (values.is_uniform()) return text_of(values[0]);
        std::vector<std::string> texts;
        const std::int64_t shown = std::min(values.size(), std::int64_t{printed_values});
        for (std::int64_t i = 0; i < shown; ++i) texts.push_back(text_of(values[i]));
        if (values.size() > shown) texts.push_back(fmt::format("... ({})", values.size()));
        return fmt::format("{{{}}}", fmt::join(texts, " "));
    }

    void bounds() {
        const auto bounded = [](const Fluent& fluent) {
            const auto finite = [](double bound) {
                return bound - bound == 0;
            };
            return std::ranges::any_of(*fluent.lower, finite) ||
                   std::ranges::any_of(*fluent.upper, finite);
        };
        if (std::ranges::none_of(program_.fluents, bounded)) return;
        writer_.line().line("bounds").indent();
        for (const Fluent& fluent : program_.fluents) {
            if (!bounded(fluent)) continue;
            writer_.line(fmt::format("{} in {} .. {}", fluent.name, limits(*fluent.lower),
                                     limits(*fluent.upper)));
        }
        writer_.dedent();
    }

    static std::string limits(const std::vector<double>& limits) {
        return values(std::vector<Value>(limits.begin(), limits.end()));
    }

    void sites() {
        if (program_.sites.empty()) return;
        writer_.line().line("sites").indent();
        for (std::size_t index = 0; index < program_.sites.size(); ++index) {
            const Site& site = program_.sites[index];
            std::vector<std::string> scope;
            for (VariableId variable : site.scope) scope.push_back(binding(variable));
            writer_.line(fmt::format(
                "@{} {}{}{}{}", index, site.what, scope.empty() ? "" : " over ",
                fmt::join(scope, ", "),
                site.series ? fmt::format(", numbers of @{}", site.series->index) : ""));
        }
        writer_.dedent();
    }

    // --------------------------------------------------------------------- statements

    void conditions(std::string_view name, const std::vector<Computation>& conditions) {
        for (std::size_t index = 0; index < conditions.size(); ++index)
            computation(fmt::format("{} {}", name, index), conditions[index]);
    }

    void computation(const std::string& name, const Computation& computation) {
        if (computation.body.empty()) {
            writer_.line(name + " = " + expression(computation.value));
            return;
        }
        writer_.line(name).indent();
        block(computation.body);
        writer_.line("= " + expression(computation.value)).dedent();
    }

    void policy(const Policy& policy) {
        writer_.line().line("policy " + policy.name).indent();
        for (const Definition& definition : policy.act) block(definition.body);
        writer_.dedent();
    }

    void block(const Block& statements) {
        for (const Statement& statement : statements) {
            match(statement.form, [&](const auto& form) { print(form); });
        }
    }

    void print(const Let& let) {
        writer_.line(fmt::format("let %{} = {}", let.local.index, expression(let.value)));
    }
    void print(const Store& store) {
        writer_.line(element(store.target, store.indices) + " = " + expression(store.value));
    }
    void print(const Spread& spread) {
        writer_.line(fmt::format("spread {} = {}", element(spread.target, spread.indices),
                                 expression(spread.bits)));
    }
    void print(const Loop& loop) {
        const char* const how = loop.as_words          ? ", as words"
                                : loop.several_at_once ? ", several at once"
                                : loop.shifts          ? ", shifts"
                                                       : "";
        const std::string affected =
            loop.affected ? ", affected by " + element(loop.affected->few, {}) : "";
        const bool has_moves = loop.affected && loop.affected->moves;
        const std::string chosen = loop.chosen ? chosen_by(*loop.chosen) : "";
        writer_
            .line(fmt::format("for {}{}{}{}{}{}", binding(loop.variable), how, affected,
                              has_moves ? moved(*loop.affected->moves) : "", chosen,
                              loop.clearances ? near(*loop.clearances) : ""))
            .indent();
        block(loop.body);
        writer_.dedent();
    }

    // ", chosen by action.take, others state.passed"
    std::string chosen_by(const Chosen& chosen) {
        return fmt::format(", chosen by {}, others {}", element(chosen.few, {}),
                           chosen.kept ? element(*chosen.kept, {}) : "false");
    }
    // ", moves at-moves[action.north, action.south]"
    std::string moved(const Moves& moves) {
        std::string choices;
        for (const BufferId choice : moves.choices)
            choices += (choices.empty() ? "" : ", ") + element(choice, {});
        return fmt::format(", moves {}[{}]", program_[moves.table].name, choices);
    }

    // ", near clearances[state.x, state.y] of scratch.dx, scratch.dy"
    std::string near(const Clearances& clearances) {
        const auto list = [&](const std::vector<BufferId>& numbers) {
            std::string text;
            for (const BufferId number : numbers)
                text += (text.empty() ? "" : ", ") + element(number, {});
            return text;
        };
        std::string text =
            fmt::format(", near {}[{}]", program_[clearances.table].name, list(clearances.places));
        if (!clearances.moves.empty()) text += " of " + list(clearances.moves);
        return text;
    }

    void print(const Visit& visit) {
        writer_.line(fmt::format("for true {}", expression(visit.condition))).indent();
        if (visit.entries) {
            const std::string rows = program_[visit.entries->rows].name,
                              visited = program_[visit.visited].name;
            writer_.line(fmt::format("for {} in {}[{}] .. {}[{} + 1]",
                                     program_[visit.entries->variable].name, rows, visited, rows,
                                     visited));
            writer_.indent();
        }
        for (const Mark& mark : visit.marks)
            writer_.line(fmt::format("{} = {} where {}", element(mark.target, mark.indices),
                                     mark.value, expression(mark.condition)));
        if (visit.entries) writer_.dedent();
        writer_.dedent();
    }
    void print(const Call& call) {
        std::vector<std::string> arguments;
        for (NodeId scalar : call.scalars) arguments.push_back(expression(scalar));
        for (const TableView& input : call.inputs) {
            arguments.push_back(element(input.buffer, input.indices));
        }
        const std::string rddl_name = ir::name_of(program_, call.callee);
        const std::string name = is_external(call.callee) ? rddl_name : lower_case(rddl_name);
        writer_.line(fmt::format(
            "fill {} = {}({})", element(call.output.buffer, call.output.indices),
            call.place ? "sample " + name + at(*call.place) : name, fmt::join(arguments, ", ")));
    }

    // -------------------------------------------------------------------- expressions

    std::string expression(NodeId id, Precedence context) const {
        return match(program_[id].form,
                     [&](const auto& form) { return text(form, program_[id].type, context); });
    }

    std::string list(const std::vector<NodeId>& ids) const {
        std::vector<std::string> texts;
        for (NodeId id : ids) texts.push_back(expression(id));
        return fmt::format("{}", fmt::join(texts, ", "));
    }

    std::string binding(VariableId id, const std::optional<Bounds>& bounds = {}) const {
        const Variable& variable = program_[id];
        if (bounds) {
            return fmt::format("{} in {} .. {}", variable.name, expression(bounds->begin),
                               expression(bounds->end));
        }
        if (!variable.type) return fmt::format("{} in 0 .. {}", variable.name, variable.size);
        return fmt::format("{} in {}", variable.name, program_.types[*variable.type].name);
    }

    std::string element(BufferId id, const std::vector<NodeId>& indices) const {
        const Buffer& buffer = program_[id];
        const bool bare = buffer.storage == Storage::Constant;
        const std::string name =
            bare ? buffer.name : fmt::format("{}.{}", name_of(buffer.storage), buffer.name);
        return indices.empty() ? name : fmt::format("{}[{}]", name, list(indices));
    }

    std::string at(const Place& place) const {
        return fmt::format("@{}[{}]", place.site.index, expression(place.index));
    }

    std::string text(const Constant& form, Scalar, Precedence) const { return text_of(form.value); }
    std::string text(const Index& form, Scalar, Precedence) const {
        return program_[form.variable].name;
    }
    std::string text(const Load& form, Scalar, Precedence) const {
        constexpr std::string_view how[] = {"",      "adjacent ", "in row ",
                                            "rows ", "own ",      "chances "};
        return fmt::format("{}{}", how[static_cast<std::size_t>(form.gather)],
                           element(form.buffer, form.indices));
    }
    std::string text(const Search& form, Scalar, Precedence) const {
        return fmt::format("search({}, {})", element(form.table, {}), expression(form.value));
    }
    std::string text(const Bits& form, Scalar, Precedence) const {
        return fmt::format("bits({}, {})", element(form.buffer, form.indices), form.first);
    }
    std::string text(const Union& form, Scalar, Precedence) const {
        return fmt::format("union[{}]({})", element(form.masks, form.row), expression(form.bits));
    }
    std::string text(const Element& form, Scalar, Precedence) const {
        return fmt::format("element({}, {})", element(form.buffer, form.indices),
                           expression(form.place));
    }
    std::string text(const Local& form, Scalar, Precedence) const {
        return fmt::format("%{}", form.local.index);
    }
    std::string text(const Convert& form, Scalar type, Precedence) const {
        return fmt::format("{}{}({})", form.skips_int ? "rounded " : "", name_of(type),
                           expression(form.operand));
    }

    std::string text(const Apply& form, Scalar, Precedence context) const {
        if (const auto infix = infix_of(form.op)) return infix_text(form, *infix, context);
        if (const auto prefix = prefix_of(form.op)) {
            return fmt::format("{}{}", *prefix, expression(form.operands.front(), unary_level));
        }
        return fmt::format("{}{}({})", rddlc::name_of(form.op), form.place ? at(*form.place) : "",
                           list(form.operands));
    }

    std::string infix_text(const Apply& form, Infix infix, Precedence context) const {
        const auto next = static_cast<Precedence>(infix.level + 1);
        const std::string text =
            fmt::format("{} {} {}", expression(form.operands.front(), infix.level), infix.symbol,
                        expression(form.operands.back(), next));
        return infix.level < context ? "(" + text + ")" : text;
    }

    std::string text(const Select& form, Scalar, Precedence) const {
        constexpr std::string_view how[] = {"", " both in packs", " both", " mostly first",
                                            " by a jump"};
        return fmt::format("select{}({})", how[static_cast<std::size_t>(form.evaluated)],
                           list({form.condition, form.then_value, form.else_value}));
    }
    std::string text(const Reduce& form, Scalar, Precedence) const {
        const char* const elements = form.over_true         ? " over true"
                                     : form.several_at_once ? " several at once"
                                                            : "";
        return fmt::format("{}{}[{}]({})", rddlc::name_of(form.op), elements,
                           binding(form.variable, form.bounds), expression(form.body));
    }
    std::string text(const Sample& form, Scalar, Precedence) const {
        return fmt::format("sample {}{}{}({})", form.is_valid ? "valid " : "",
                           lower_case(rddlc::name_of(form.distribution)), at(form.place),
                           list(form.parameters));
    }
    std::string text(const Discrete& form, Scalar, Precedence) const {
        return fmt::format("sample {}{}({})", discrete_name(form.normalise), at(form.place),
                           list(form.weights));
    }
    std::string text(const DiscreteOver& form, Scalar, Precedence) const {
        return fmt::format("sample {}{}[{}]({})", discrete_name(form.normalise), at(form.place),
                           binding(form.variable), expression(form.weight));
    }
    std::string text(const Interval& form, Scalar, Precedence) const {
        return fmt::format("sample interval{}({})", at(form.place), element(form.table, form.row));
    }
    std::string text(const Fault& form, Scalar, Precedence) const {
        return "fault" + at(form.place);
    }

    static std::string_view discrete_name(bool normalise) {
        return normalise ? "unnormdiscrete" : "discrete";
    }

    const Program& program_;
    Writer writer_;
};

}  // namespace

std::string print(const Program& program) {
    return Printer(program).whole_program();
}

std::string print(const Program& program, NodeId id) {
    return Printer(program).expression(id);
}

}  // namespace rddlc::ir
