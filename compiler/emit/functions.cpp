// Over 400 lines: a function for each emitted function.
#include "emit/functions.hpp"

#include "emit/function_body.hpp"
#include "emit/layout.hpp"
#include "emit/line_directives.hpp"
#include "emit/literals.hpp"
#include "emit/tables.hpp"
#include "emit/templates.hpp"
#include "support/template_slots.hpp"
#include "support/utf8.hpp"

#include <algorithm>
#include <cctype>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::cpp {
namespace {

constexpr int level = 1;  // of the members of Simulator and Policy

// A function with more calls makes them in functions of their own, each of some. They are not
// inlined: what grows with the problem is the number of functions, and compilers take their time
// for large ones.
constexpr std::size_t most_calls = 64;
constexpr std::size_t calls_in_part = 32;

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
    return {record_parameter(ir::Storage::State, uses.state, false),
            record_parameter(ir::Storage::Action, uses.action, false),
            record_parameter(ir::Storage::Scratch, uses.scratch, uses.stores_scratch),
            record_parameter(ir::Storage::Next, uses.next, uses.stores_next),
            record_parameter(ir::Storage::Observation, uses.observation, uses.stores_observation),
            context_parameter(uses)};
}

// Those of a function of the policy, which sees the observation if there is one, else the state.
std::vector<Parameter> policy_parameters(const Unit& unit, const Uses& uses) {
    return {unit.program.partially_observed()
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
                      const std::vector<Parameter>& parameters, const std::string& attribute) {
    std::vector<std::string> declarations;
    for (const Parameter& parameter : parameters) declarations.push_back(declaration(parameter));
    std::string text = indented("template <class L>", level);
    const std::size_t column = level * indentation;
    for (const std::string& line : fill_call(attribute + "static " + result + " " + name + "(",
                                             declarations, ") {", column)) {
        text += indented(line, level);
    }
    return text;
}

std::string function(const std::string& result, const std::string& name,
                     const std::vector<Parameter>& parameters, const std::string& body,
                     const std::string& attribute = "") {
    std::string text = signature(result, name, parameters, attribute);
    // An empty body stands on the last line of the signature.
    if (body.empty()) return text.substr(0, text.size() - 1) + "}\n";
    return text + body + indented("}", level);
}

// Not as a member of a record, which is the user's.
bool has_word(const std::string& text, std::string_view word) {
    const auto is_part = [&](std::size_t at) {
        return at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) ||
                                    text[at] == '_' || text[at] == '.');
    };
    for (std::size_t at = 0; (at = text.find(word, at)) != text.npos; at += word.size())
        if ((at == 0 || !is_part(at - 1)) && !is_part(at + word.size())) return true;
    return false;
}

// Of the types that the text names: nothing else has these names.
std::string type_aliases(std::span<const std::string> lines) {
    std::string text;
    for (const std::string word : {"Bool", "Int", "Real"})
        if (std::ranges::any_of(lines,
                                [&](const std::string& line) { return has_word(line, word); }))
            text += indented("using " + word + " = typename L::" + word + ";", level + 1);
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
    return type_aliases(body.lines()) + (has_scratch ? own_scratch() : "") +
           statements_text(unit, body.lines(), span);
}

// One line of comment, cut to the width of the page.
std::string comment(std::string text, const std::string& place) {
    text = comment_text(text);
    const std::string tail = place.empty() ? "" : "  (" + place + ")";
    const std::size_t room = line_width - level * indentation - 3 - tail.size();
    if (text.size() > room) {
        std::size_t end = room - 3;
        while (end > 0 && !begins_character(text[end])) --end;
        text = text.substr(0, end) + "...";
    }
    return indented("// " + text + tail, level);
}

// "rlevel'(?r)" of "rlevel'(?r) = ...;"
std::string lifted_head(const Unit& unit, const ir::Definition& definition) {
    const std::string text = unit.sources.text_on_one_line(definition.span);
    std::string head = text.substr(0, text.find('='));
    while (head.ends_with(' ')) head.pop_back();
    return head;
}

// Which definitions: the step's or the policy's.
enum class Owner { Simulator, Policy };

std::string cpf_comment(const Unit& unit, const ir::Definition& definition, Owner owner) {
    const std::string place = unit.where(definition.span);
    const ir::Buffer& target = unit.program[definition.target];
    const bool is_cpf = target.fluent || owner == Owner::Policy;
    if (!is_cpf && target.storage == ir::Storage::Observation)  // a precondition
        return comment(unit.sources.text_on_one_line(definition.span), place);
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
    all.stores_state |= some.stores_state;
    all.stores_action |= some.stores_action;
    all.stores_scratch |= some.stores_scratch;
    all.stores_next |= some.stores_next;
    all.stores_observation |= some.stores_observation;
    all.stores_next_memory |= some.stores_next_memory;
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

// "name(state, next);" as lines.
std::string call(const std::string& name, const std::string& arguments) {
    std::string text;
    for (const std::string& line : fill_call(name + "(", {arguments}, ");", level * indentation))
        text += indented(line, level + 1);
    return text;
}

// Statements, each a call with what it uses.
struct Call {
    std::string text;
    Uses uses;
};

// What a function consists of, and the parts that it calls, if there are too many.
struct Calls {
    std::string text;
    std::string parts;
};

// A part takes what its calls use: `parameters_of` tells.
template <class ParametersOf>
Calls in_parts(const std::string& name, const std::vector<Call>& calls,
               ParametersOf&& parameters_of) {
    Calls result;
    if (calls.size() <= most_calls) {
        for (const Call& each : calls) result.text += each.text;
        return result;
    }
    for (std::size_t begin = 0; begin < calls.size(); begin += calls_in_part) {
        const std::size_t end = std::min(begin + calls_in_part, calls.size());
        Uses uses;
        std::string body;
        for (std::size_t k = begin; k < end; ++k) {
            unite(uses, calls[k].uses);
            body += calls[k].text;
        }
        const std::vector<Parameter> parameters = only_used(parameters_of(uses));
        const std::string part = name + "_" + std::to_string(begin / calls_in_part);
        result.text += call(part, arguments(parameters));
        result.parts += "\n" + function("void", part, parameters, body, "[[gnu::noinline]] ");
    }
    return result;
}

// A function for each definition, and the lines that call them.
struct CpfFunctions {
    std::string calls;
    std::string functions;
    Uses uses;  // of all together
};

CpfFunctions cpf_functions(const Unit& unit, const std::string& caller,
                           const std::vector<ir::Definition>& definitions,
                           const std::vector<std::string>& names, Owner owner) {
    CpfFunctions result;
    std::vector<Call> calls;
    for (std::size_t k = 0; k < definitions.size(); ++k) {
        const ir::Definition& definition = definitions[k];
        FunctionBody body(unit, level + 1);
        body.block(definition.body);
        const Uses& uses = body.uses();
        unite(result.uses, uses);
        const std::vector<Parameter> parameters = only_used(parameters_of(unit, uses, owner));
        calls.push_back({call(names[k], arguments(parameters)), uses});
        result.functions +=
            (k > 0 ? "\n" : "") + cpf_comment(unit, definition, owner) +
            function("void", names[k], parameters, body_text(unit, body, definition.span));
    }
    const Calls parted =
        in_parts(caller, calls, [&](const Uses& uses) { return parameters_of(unit, uses, owner); });
    result.calls = parted.text;
    result.functions += parted.parts;
    return result;
}

struct ConditionKind {
    std::string word;      // "precondition"
    std::string function;  // of all: "violated_precondition"
    std::string comment;
    std::string type;      // of its result, in L
    std::string none;      // the result where there are none
    std::string gathered;  // the class that adds them up (rddl/step/conditions.hpp)
    std::string result;    // its member that says what they say
};

const std::string conditions_name = "conditions";

// "if (conditions.go_on()) conditions.add(3, precondition_3(state));"
std::string add_condition(const ConditionKind& kind, std::size_t k, const std::string& condition) {
    const bool is_lazy = kind.word != "termination";
    const std::string number = kind.word == "precondition" ? std::to_string(k) + ", " : "";
    return indented((is_lazy ? "if (" + conditions_name + ".go_on()) " : "") + conditions_name +
                        ".add(" + number + condition + ");",
                    level + 1);
}

std::string conditions(const Unit& unit, const ConditionKind& kind,
                       const std::vector<ir::Computation>& computations) {
    Uses all;
    std::vector<Call> calls;
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
        const std::string condition =
            name + (parameters.empty() ? "<L>(" : "(") + arguments(parameters) + ")";
        calls.push_back({add_condition(kind, k, condition), uses});
        functions += "\n" + comment(unit.sources.text_on_one_line(computation.span),
                                    unit.where(computation.span));
        functions += function("typename L::Bool", name, parameters,
                              body_text(unit, body, computation.span, has_scratch));
    }
    const std::string gathered = "rddl::" + kind.gathered + "<L>";
    const Calls parted = in_parts(kind.word + "s", calls, [&](const Uses& uses) {
        std::vector<Parameter> parameters = record_parameters(uses);
        parameters.insert(parameters.begin(), {gathered + "&", conditions_name, true});
        return parameters;
    });
    const bool takes_context = kind.word != "termination" && !computations.empty();
    all.context |= takes_context;
    std::vector<Parameter> parameters = {record_parameter(ir::Storage::State, all.state, false)};
    if (kind.word == "precondition")
        parameters.push_back(record_parameter(ir::Storage::Action, all.action, false));
    parameters.push_back(context_parameter(all));
    const std::string object =
        gathered + " " + conditions_name + (takes_context ? "(context);" : ";");
    const std::string body =
        computations.empty()
            ? indented("return " + kind.none + ";", level + 1)
            : indented(object, level + 1) + parted.text +
                  indented("return " + conditions_name + "." + kind.result + "();", level + 1);
    return indented("// " + kind.comment, level) +
           function("typename L::" + kind.type, kind.function, parameters, body) + functions +
           parted.parts;
}

}  // namespace

std::string assignments(const Unit& unit, ir::Storage storage, const std::string& record,
                        int levels) {
    std::string text;
    for (std::size_t index = 0; index < unit.program.buffers.size(); ++index) {
        const ir::Buffer& buffer = unit.program.buffers[index];
        if (buffer.storage != storage || buffer.values.empty()) continue;
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

std::string record_aliases(const Unit& unit, const std::vector<std::string>& records) {
    std::string text;
    for (const std::string& record : records) text += alias(unit, record, record);
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
    const Parameter state = record_parameter(ir::Storage::State, has_values || uses.state, true);
    if (draws.empty()) return function("void", "reset", {state, context_parameter(uses)}, text);
    return function("void", "initial_state", {state}, text) + "\n" +
           indented("// With what is drawn at random.", level) +
           function("void", "reset", {state, context_parameter(uses)},
                    type_aliases(body.lines()) + (uses.scratch ? own_scratch() : "") +
                        indented("initial_state(state);", level + 1) + draws);
}

std::string reward_function(const Unit& unit) {
    const ir::Computation& reward = unit.program.reward;
    FunctionBody body(unit, level + 1);
    body.block(reward.body);
    body.return_value(reward.value);
    const Uses& uses = body.uses();
    return function(
        "typename L::Real", "reward",
        {record_parameter(ir::Storage::State, uses.state, false),
         record_parameter(ir::Storage::Action, uses.action, false),
         record_parameter(ir::Storage::Scratch, uses.scratch, uses.stores_scratch),
         record_parameter(ir::Storage::Next, uses.next, false), context_parameter(uses)},
        body_text(unit, body, reward.span));
}

std::string condition_functions(const Unit& unit) {
    const ir::Program& program = unit.program;
    return conditions(unit,
                      {"termination", "terminal", "An episode ends where one of these holds.",
                       "Bool", "false", "Terminations", "hold"},
                      program.terminations) +
           "\n" +
           conditions(unit,
                      {"invariant", "violates_invariant", "Hold in every state that makes sense.",
                       "Bool", "false", "Invariants", "violated"},
                      program.invariants) +
           "\n" +
           conditions(unit,
                      {"precondition", "violated_precondition",
                       "Hold for every action that is allowed: the first that does not, or -1.",
                       "Int", "typename L::Int{-1}", "Preconditions", "first_violated"},
                      program.preconditions);
}

StepFunctions step_functions(const Unit& unit) {
    CpfFunctions cpfs =
        cpf_functions(unit, "step", unit.program.step, unit.names.functions, Owner::Simulator);
    Uses& uses = cpfs.uses;
    uses.stores_scratch = uses.stores_next = uses.stores_observation = true;
    return {function("void", "step", record_parameters(uses), cpfs.calls), cpfs.functions};
}

std::string moderate_test(const Unit& unit) {
    Uses uses;
    std::string tests;
    for (const ir::BufferId id : ir::reals_taken_for_moderate(unit.program)) {
        const ir::Storage storage = unit.program[id].storage;
        (storage == ir::Storage::State ? uses.state : uses.action) = true;
        tests += (tests.empty() ? "" : " && ") + std::string("rddl::is_moderate<L>(") +
                 words_of(storage).parameter + "." + unit.names.buffers[id.index] + ")";
    }
    std::string body;
    for (const std::string& line : fill_chain("return ", (tests.empty() ? "true" : tests) + ";",
                                              {"&&"}, (level + 1) * indentation))
        body += indented(line, level + 1);
    return function("typename L::Bool", "is_for",
                    {record_parameter(ir::Storage::State, uses.state, false),
                     record_parameter(ir::Storage::Action, uses.action, false)},
                    body);
}

std::string policy(const Unit& unit) {
    if (!unit.program.policy) return "";
    CpfFunctions cpfs = cpf_functions(unit, "act", unit.program.policy->act,
                                      unit.names.policy_functions, Owner::Policy);
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
