#include "emit/functions.hpp"

#include "emit/function_body.hpp"
#include "emit/layout.hpp"
#include "emit/line_directives.hpp"
#include "emit/literals.hpp"
#include "emit/tables.hpp"
#include "emit/templates.hpp"
#include "support/template_slots.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::cpp {
namespace {

constexpr int level = 1;  // of the members of Simulator and Policy

std::string indented(const std::string& text, int levels) {
    return std::string(static_cast<std::size_t>(levels * indentation), ' ') + text + "\n";
}

struct Parameter {
    std::string type;
    std::string name;
    bool used;
};

std::string declaration(const Parameter& parameter) {
    const std::string name = parameter.used ? parameter.name : "/*" + parameter.name + "*/";
    return parameter.type + " " + name;
}

Parameter record_parameter(ir::Storage storage, bool used, bool stored) {
    const RecordWords words = words_of(storage);
    return {(stored ? "" : "const ") + words.type + "<L>&", words.parameter, used};
}

Parameter context_parameter(const Uses& uses) {
    return {"rddl::Context<L>&", "context", uses.context};
}

// All records that a function might take, in the order of every signature.
std::vector<Parameter> record_parameters(const Uses& uses) {
    return {
        record_parameter(ir::Storage::State, uses.state, false),
        record_parameter(ir::Storage::Action, uses.action, false),
        record_parameter(ir::Storage::Scratch, uses.scratch, uses.stores_scratch),
        record_parameter(ir::Storage::Next, uses.next, uses.stores_next),
        record_parameter(ir::Storage::Observation, uses.observation, uses.stores_observation),
        context_parameter(uses)};
}

// Those of a function of the policy, which sees the observation if there is one, else the state.
std::vector<Parameter> policy_parameters(const Unit& unit, const Uses& uses) {
    return {
        unit.program.partially_observed()
            ? record_parameter(ir::Storage::Observation, uses.observation, false)
            : record_parameter(ir::Storage::State, uses.state, false),
        record_parameter(ir::Storage::Memory, uses.memory, false),
        record_parameter(ir::Storage::Scratch, uses.scratch, uses.stores_scratch),
        record_parameter(ir::Storage::Action, uses.action, uses.stores_action),
        record_parameter(ir::Storage::NextMemory, uses.next_memory, uses.stores_next_memory),
        context_parameter(uses)};
}

std::vector<Parameter> only_used(std::vector<Parameter> parameters) {
    std::erase_if(parameters, [](const Parameter& parameter) { return !parameter.used; });
    return parameters;
}

std::string arguments(const std::vector<Parameter>& parameters) {
    std::string text;
    for (const Parameter& parameter : parameters)
        text += (text.empty() ? "" : ", ") + parameter.name;
    return text;
}

std::string signature(const std::string& result, const std::string& name,
                      const std::vector<Parameter>& parameters) {
    std::vector<std::string> declarations;
    for (const Parameter& parameter : parameters) declarations.push_back(declaration(parameter));
    std::string text = indented("template <class L>", level);
    const std::size_t column = level * indentation;
    for (const std::string& line :
         fill_call("static " + result + " " + name + "(", declarations, ") {", column)) {
        text += indented(line, level);
    }
    return text;
}

std::string function(const std::string& result, const std::string& name,
                     const std::vector<Parameter>& parameters, const std::string& body) {
    std::string text = signature(result, name, parameters);
    // An empty body stands on the last line of the signature.
    if (body.empty()) return text.substr(0, text.size() - 1) + "}\n";
    return text + body + indented("}", level);
}

std::string type_aliases(const Uses& uses) {
    std::string text;
    if (uses.bool_type) text += indented("using Bool = typename L::Bool;", level + 1);
    if (uses.int_type) text += indented("using Int = typename L::Int;", level + 1);
    if (uses.real_type) text += indented("using Real = typename L::Real;", level + 1);
    return text;
}

// What a function has for itself that has no records for its tables.
std::string own_scratch() {
    return indented("Scratch<L> scratch{};", level + 1);
}

std::string statements_text(const Unit& unit, std::span<const std::string> lines, Span span) {
    const bool directives = unit.options.line_directives;
    std::string text;
    for (const std::string& line : lines) {
        if (directives) text += line_directive(unit.sources, span);
        text += line + "\n";
    }
    return text + std::string(directives ? line_restorer : "");
}

std::string body_text(const Unit& unit, FunctionBody& body, Span span, bool has_scratch = false) {
    return type_aliases(body.uses()) + (has_scratch ? own_scratch() : "") +
           statements_text(unit, body.lines(), span);
}

// One line of comment, cut to the width of the page.
std::string comment(std::string text, const std::string& place) {
    text = comment_text(text);
    const std::string tail = place.empty() ? "" : "  (" + place + ")";
    const std::size_t room = line_width - level * indentation - 3 - tail.size();
    if (text.size() > room) {
        std::size_t end = room - 3;
        while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
        text = text.substr(0, end) + "...";
    }
    return indented("// " + text + tail, level);
}

// "rlevel'(?r)" of "rlevel'(?r) = ...;"
std::string lifted_head(const Unit& unit, const ir::Definition& definition) {
    const std::string text = on_one_line(unit.sources.text(definition.span));
    std::string head = text.substr(0, text.find('='));
    while (head.ends_with(' ')) head.pop_back();
    return head;
}

// Which definitions: the step's or the policy's.
enum class Owner { Simulator, Policy };

std::string cpf_comment(const Unit& unit, const ir::Definition& definition, Owner owner) {
    const std::string place = unit.where(definition.span);
    const bool is_cpf = unit.program[definition.target].fluent || owner == Owner::Policy;
    return comment((is_cpf ? "" : "A table for ") + lifted_head(unit, definition), place);
}

std::vector<Parameter> parameters_of(const Unit& unit, const Uses& uses, Owner owner) {
    return owner == Owner::Policy ? policy_parameters(unit, uses) : record_parameters(uses);
}

void unite(Uses& all, const Uses& some) {
    all.state |= some.state;
    all.action |= some.action;
    all.scratch |= some.scratch;
    all.next |= some.next;
    all.observation |= some.observation;
    all.memory |= some.memory;
    all.next_memory |= some.next_memory;
    all.context |= some.context;
}

// A record by the name that the runtime looks for.
std::string alias(const Unit& unit, const std::string& name, const std::string& record) {
    const std::string head = "using " + name + " =";
    const std::string target = unit.names.space + "::" + record + "<L>;";
    const bool fits = level * indentation + head.size() + 1 + target.size() <= line_width;
    return indented("template <class L>", level) +
           (fits ? indented(head + " " + target, level)
                 : indented(head, level) + indented(target, level + 1));
}

// A function for each definition, and the lines that call them.
struct CpfFunctions {
    std::string calls;
    std::string functions;
    Uses uses;  // of all together
};

CpfFunctions cpf_functions(const Unit& unit, const std::vector<ir::Definition>& definitions,
                           const std::vector<std::string>& names, Owner owner) {
    CpfFunctions result;
    for (std::size_t k = 0; k < definitions.size(); ++k) {
        const ir::Definition& definition = definitions[k];
        FunctionBody body(unit, level + 1);
        body.block(definition.body);
        const Uses& uses = body.uses();
        unite(result.uses, uses);
        const std::vector<Parameter> parameters = only_used(parameters_of(unit, uses, owner));
        for (const std::string& line :
             fill_call(names[k] + "(", {arguments(parameters)}, ");", level * indentation)) {
            result.calls += indented(line, level + 1);
        }
        result.functions +=
            (k > 0 ? "\n" : "") + cpf_comment(unit, definition, owner) +
            function("void", names[k], parameters, body_text(unit, body, definition.span));
    }
    return result;
}

std::string condition_switch(const std::vector<std::string>& calls, const char* otherwise) {
    if (calls.empty()) return indented(std::string("return ") + otherwise + ";", level + 1);
    std::string text = indented("switch (k) {", level + 1);
    for (std::size_t k = 0; k < calls.size(); ++k) {
        text += indented("case " + std::to_string(k) + ":", level + 2);
        text += indented("return " + calls[k] + ";", level + 3);
    }
    text += indented("default:", level + 2);
    text += indented(std::string("return ") + otherwise + ";", level + 3);
    return text + indented("}", level + 1);
}

struct ConditionKind {
    std::string word;  // "precondition"
    std::string comment;
    const char* otherwise;  // the value of a condition that does not exist
    bool has_action;
};

std::string conditions(const Unit& unit, const ConditionKind& kind,
                       const std::vector<ir::Computation>& computations) {
    Uses all;
    std::vector<std::string> calls;
    std::string functions;
    for (std::size_t k = 0; k < computations.size(); ++k) {
        const ir::Computation& computation = computations[k];
        FunctionBody body(unit, level + 1);
        body.block(computation.body);
        body.return_value(computation.value);
        // Nobody hands tables to conditions; those that need some have their own.
        Uses uses = body.uses();
        const bool has_scratch = std::exchange(uses.scratch, false);
        unite(all, uses);
        const std::vector<Parameter> parameters = only_used(record_parameters(uses));
        const std::string name = kind.word + "_" + std::to_string(k);
        calls.push_back(name + (parameters.empty() ? "<L>(" : "(") + arguments(parameters) + ")");
        functions += "\n" + comment(on_one_line(unit.sources.text(computation.span)),
                                    unit.where(computation.span));
        functions += function("typename L::Bool", name, parameters,
                              body_text(unit, body, computation.span, has_scratch));
    }
    std::vector<Parameter> parameters = {{"rddl::Index", "k", !computations.empty()},
                                         record_parameter(ir::Storage::State, all.state, false)};
    if (kind.has_action) {
        parameters.push_back(record_parameter(ir::Storage::Action, all.action, false));
    }
    parameters.push_back(context_parameter(all));
    return indented("// " + kind.comment, level) +
           function("typename L::Bool", kind.word, parameters,
                    condition_switch(calls, kind.otherwise)) +
           functions;
}

// Every element of the buffer is drawn when an episode starts.
bool is_drawn(const ir::Program& program, std::size_t index) {
    const auto draws = std::ranges::count_if(
        program.reset, [&](const ir::Definition& d) { return d.target.index == index; });
    return draws == program.buffers[index].count();
}

}  // namespace

std::string assignments(const Unit& unit, ir::Storage storage, const std::string& record,
                        int levels) {
    std::string text;
    for (std::size_t index = 0; index < unit.program.buffers.size(); ++index) {
        const ir::Buffer& buffer = unit.program.buffers[index];
        if (buffer.storage != storage || buffer.values.empty()) continue;
        if (is_drawn(unit.program, index)) continue;
        const std::string target = record + "." + unit.names.buffers[index];
        const std::string& table = unit.names.initial[index];
        const std::string value =
            table.empty() ? literal(buffer.values[0], unit.program.real) : table;
        text += indented(buffer.shape.empty() ? target + " = " + value + ";"
                                              : "rddl::assign(" + target + ", " + value + ");",
                         levels);
    }
    return text;
}

std::string record_aliases(const Unit& unit) {
    std::string text;
    for (const std::string record : {"State", "Action", "Scratch", "Observation"})
        text += alias(unit, record, record);
    return text;
}

// The values that are given, then what is drawn.
std::string reset_function(const Unit& unit) {
    std::string text = assignments(unit, ir::Storage::State, "state", level + 1);
    const bool has_values = !text.empty();
    FunctionBody body(unit, level + 1);
    std::string draws;
    for (const ir::Definition& definition : unit.program.reset) {
        const std::size_t before = body.lines().size();
        body.block(definition.body);
        draws += statements_text(unit, std::span(body.lines()).subspan(before), definition.span);
    }
    const Uses& uses = body.uses();
    if (uses.scratch) text += own_scratch();
    return function("void", "reset",
                    {record_parameter(ir::Storage::State, has_values || uses.state, true),
                     context_parameter(uses)},
                    type_aliases(uses) + text + draws);
}

std::string reward_function(const Unit& unit) {
    const ir::Computation& reward = unit.program.reward;
    FunctionBody body(unit, level + 1);
    body.block(reward.body);
    body.return_value(reward.value);
    const Uses& uses = body.uses();
    return function("typename L::Real", "reward",
                    {record_parameter(ir::Storage::State, uses.state, false),
                     record_parameter(ir::Storage::Action, uses.action, false),
                     record_parameter(ir::Storage::Scratch, uses.scratch, uses.stores_scratch),
                     record_parameter(ir::Storage::Next, uses.next, false), context_parameter(uses)},
                    body_text(unit, body, reward.span));
}

std::string condition_functions(const Unit& unit) {
    const ir::Program& program = unit.program;
    return conditions(unit,
                      {"termination", "An episode ends where one of these holds.", "false", false},
                      program.terminations) +
           "\n" +
           conditions(unit, {"invariant", "Hold in every state that makes sense.", "true", false},
                      program.invariants) +
           "\n" +
           conditions(unit,
                      {"precondition", "Hold for every action that is allowed.", "true", true},
                      program.preconditions);
}

StepFunctions step_functions(const Unit& unit) {
    CpfFunctions cpfs =
        cpf_functions(unit, unit.program.step, unit.names.functions, Owner::Simulator);
    Uses& uses = cpfs.uses;
    uses.stores_scratch = uses.stores_next = uses.stores_observation = true;
    return {function("void", "step", record_parameters(uses), cpfs.calls), cpfs.functions};
}

std::string policy(const Unit& unit) {
    if (!unit.program.policy) return "";
    CpfFunctions cpfs =
        cpf_functions(unit, unit.program.policy->act, unit.names.policy_functions, Owner::Policy);
    Uses& uses = cpfs.uses;
    uses.stores_scratch = uses.stores_action = uses.stores_next_memory = true;
    const std::string initial = assignments(unit, ir::Storage::Memory, "memory", level + 1);
    const std::vector<Parameter> memory = {
        record_parameter(ir::Storage::Memory, !initial.empty(), true)};
    return fill_slots(templates::policy,
                      {{"name", comment_text(unit.program.policy->name)},
                       {"place", unit.where(unit.program.policy->span)},
                       {"alias", alias(unit, "Memory", "PolicyMemory")},
                       {"reset", function("void", "reset", memory, initial)},
                       {"act", function("void", "act", policy_parameters(unit, uses), cpfs.calls)},
                       {"cpfs", cpfs.functions}});
}

}  // namespace rddlc::cpp
