// Over 400 lines: a function for each emitted function.
#include "emit/lower/functions.hpp"

#include "emit/cpp/line_directives.hpp"
#include "emit/cpp/literals.hpp"
#include "emit/cpp/print.hpp"
#include "emit/lower/operators.hpp"
#include "emit/lower/statements.hpp"
#include "emit/lower/tables.hpp"
#include "emit/templates.hpp"
#include "ir/shifted_row.hpp"
#include "support/template_slots.hpp"
#include "support/utf8.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::cpp {
namespace {

using ir::Storage;
using tree::word;

constexpr std::size_t level = 1;  // of the members of Simulator and Policy

// A function with more calls makes them in functions of their own, each of some. They are not
// inlined: what grows with the problem is the number of functions, and compilers take their time
// for large ones.
constexpr std::size_t most_calls = 64;
constexpr std::size_t calls_in_part = 32;

// The numbers of the draws that every step makes.
const std::string step_numbers = "rddl::StepNumbers<L, step_draws>";
const std::string step_normals = "rddl::StepNormals<L, step_normals>";

struct Parameter {
    std::string type;
    std::string name;
    bool used;
};

Parameter record_parameter(Storage storage, const Uses& uses) {
    const RecordWords words = words_of(storage);
    const std::string access = uses.stored.contains(storage) ? "" : "const ";
    return {access + words.type + "<L>&", words.parameter, uses.has(storage)};
}

std::vector<Parameter> parameters_of(const std::vector<Storage>& records, const Uses& uses) {
    std::vector<Parameter> parameters;
    for (const Storage storage : records) parameters.push_back(record_parameter(storage, uses));
    parameters.push_back({"rddl::Context<L>&", "context", uses.context});
    if (uses.numbers) parameters.push_back({"const " + step_numbers + "&", "numbers", true});
    if (uses.normals) parameters.push_back({"const " + step_normals + "&", "normals", true});
    return parameters;
}

// All records that a function might take, in the order of every signature.
const std::vector<Storage> simulator_records = {Storage::State, Storage::Action, Storage::Scratch,
                                                Storage::Next, Storage::Observation};

// The parameters of a function of the policy, which sees the observation if there is one, else the
// state.
std::vector<Storage> policy_records(const Unit& unit) {
    const bool partial = unit.program.partially_observed();
    return {partial ? Storage::Observation : Storage::State, Storage::Memory, Storage::Scratch,
            Storage::Action, Storage::NextMemory};
}

std::vector<Parameter> only_used(std::vector<Parameter> parameters) {
    std::erase_if(parameters, [](const Parameter& parameter) { return !parameter.used; });
    return parameters;
}

tree::Expressions arguments(const std::vector<Parameter>& parameters) {
    tree::Expressions names;
    for (const Parameter& parameter : parameters) names.push_back(word(parameter.name));
    return names;
}

tree::Statement function(const std::string& result, const std::string& name,
                         const std::vector<Parameter>& parameters, tree::Block body,
                         const std::string& comment = "", const std::string& attribute = "") {
    tree::Expressions declared;
    for (const Parameter& parameter : parameters) {
        const std::string mark = parameter.used ? "" : "/*", end = parameter.used ? "" : "*/";
        declared.push_back({tree::Declared{parameter.type, mark + parameter.name + end}});
    }
    return {.form = tree::Function{attribute + "static ", result, name, std::move(declared),
                                   std::move(body)},
            .is_template = true,
            .comment = comment};
}

std::string lane_type_of(ir::Scalar scalar) {
    return "typename L::" + lane_type(scalar);
}

// The names that statements rely on: types, and tables that are not passed as parameters.
tree::Block prologue(const Uses& uses, bool has_scratch) {
    tree::Block lines;
    for (const ir::Scalar scalar : uses.types)
        lines.push_back(tree::assign("using " + lane_type(scalar), word(lane_type_of(scalar))));
    if (has_scratch) lines.push_back({tree::braces("Scratch<L> scratch", {})});
    return lines;
}

// Statements with the line directive of their place, if the options ask for it.
tree::Block located(const Unit& unit, tree::Block statements, Span span) {
    if (!unit.options.line_directives) return statements;
    for (tree::Statement& each : statements) each.directive = line_directive(unit.sources, span);
    return statements;
}

tree::Block body_of(const Unit& unit, FunctionBody& body, Span span, bool has_scratch = false) {
    tree::Block lines = prologue(body.uses(), has_scratch);
    append(lines, located(unit, std::move(body.statements()), span));
    return lines;
}

// The text in one line, cut to the width of the page.
std::string comment(std::string text, const std::string& place) {
    text = comment_text(text);
    const std::string tail = "  (" + place + ")";
    const std::size_t room = line_width - level * indentation - 3 - tail.size();
    if (text.size() > room) {
        std::size_t end = room - 3;
        while (end > 0 && !begins_character(text[end])) --end;
        text = text.substr(0, end) + "...";
    }
    return text + tail;
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
    const char* const what = is_cpf ? "" : target.shape.empty() ? "A value for " : "A table for ";
    return comment(what + lifted_head(unit, definition), place);
}

// A record by the name that the runtime looks for.
tree::Statement alias(const Unit& unit, const std::string& name, const std::string& record) {
    return {
        .form = tree::Assign{word("using " + name), word(unit.names.space + "::" + record + "<L>")},
        .is_template = true};
}

// A statement that is a call, with what it uses.
struct Call {
    tree::Statement statement;
    Uses uses;
};

// The parts of a function, and the functions that it calls if there are too many parts.
struct Calls {
    tree::Block statements;
    tree::Block parts;
};

// A part takes what its calls use: `parameters_of` says what.
template <class ParametersOf>
Calls in_parts(const std::string& name, std::vector<Call> calls, ParametersOf&& parameters_of) {
    Calls result;
    if (calls.size() <= most_calls) {
        for (Call& each : calls) result.statements.push_back(std::move(each.statement));
        return result;
    }
    for (std::size_t begin = 0; begin < calls.size(); begin += calls_in_part) {
        const std::size_t end = std::min(begin + calls_in_part, calls.size());
        Uses uses;
        tree::Block body;
        for (std::size_t k = begin; k < end; ++k) {
            uses.add(calls[k].uses);
            body.push_back(std::move(calls[k].statement));
        }
        const std::vector<Parameter> parameters = only_used(parameters_of(uses));
        const std::string part = name + "_" + std::to_string(begin / calls_in_part);
        result.statements.push_back({tree::call(part, arguments(parameters))});
        result.parts.push_back(
            function("void", part, parameters, std::move(body), "", "[[gnu::noinline]] "));
    }
    return result;
}

// A function for each definition, and the lines that call them.
struct CpfFunctions {
    tree::Block calls;
    tree::Block functions;
    Uses uses;  // of all together
};

// Writes the functions of definitions.
struct CpfWriter {
    const Unit& unit;
    const std::vector<ir::Definition>& definitions;
    const std::vector<std::string>& names;
    Owner owner;
    CpfFunctions result = {};

    std::vector<Parameter> parameters(const Uses& uses) const {
        return parameters_of(owner == Owner::Policy ? policy_records(unit) : simulator_records,
                             uses);
    }
    Call add(const std::string& name, const Uses& uses, tree::Block body,
             const std::string& comment) {
        const std::vector<Parameter> used = only_used(parameters(uses));
        result.functions.push_back(function("void", name, used, std::move(body), comment));
        return {{tree::call(name, arguments(used))}, uses};
    }
    Call add_definition(std::size_t k, bool tests_choices) {
        const ir::Definition& definition = definitions[k];
        FunctionBody body(unit, level + 1);
        if (tests_choices) body.keep_unchosen({&definition, 1});
        if (const ir::Loop* const loop = ir::shifting_loop(definition)) body.shift(*loop);
        body.block(definition.body);
        result.uses.add(body.uses());
        return add(names[k], body.uses(), body_of(unit, body, definition.span),
                   cpf_comment(unit, definition, owner));
    }

    // The definitions from `begin` up to the result keep tables of the state by the same test.
    std::size_t end_of_group(std::size_t begin) const {
        std::size_t end = begin + 1;
        const auto& first = definitions[begin].unchosen;
        while (first && end < definitions.size() && definitions[end].unchosen &&
               definitions[end].unchosen->choices == first->choices)
            ++end;
        return end;
    }
    // A function that makes their test, and calls the functions of all.
    Call add_group(std::size_t begin, std::size_t end, const std::string& name) {
        FunctionBody test(unit, level + 1);
        test.keep_unchosen(std::span(definitions).subspan(begin, end - begin));
        Uses uses = test.uses();
        result.uses.add(uses);
        tree::Block body = std::move(test.statements());
        tree::Block before = std::exchange(result.functions, {});
        for (std::size_t k = begin; k < end; ++k) {
            Call each = add_definition(k, false);
            uses.add(each.uses);
            body.push_back(std::move(each.statement));
        }
        tree::Block of_group = std::exchange(result.functions, std::move(before));
        const bool all_keep = std::ranges::all_of(
            std::span(definitions).subspan(begin, end - begin),
            [](const ir::Definition& each) { return each.unchosen->kept.has_value(); });
        Call call = add(name, uses, std::move(body),
                        all_keep ? "These CPFs keep the state where the action chooses nothing."
                                 : "These CPFs keep the state where the action chooses nothing, or "
                                   "only such ones read them.");
        append(result.functions, std::move(of_group));
        return call;
    }
};

CpfFunctions cpf_functions(const Unit& unit, const std::string& caller,
                           const std::vector<ir::Definition>& definitions,
                           const std::vector<std::string>& names, Owner owner) {
    CpfWriter writer{unit, definitions, names, owner};
    std::vector<Call> calls;
    std::size_t groups = 0;
    for (std::size_t k = 0, end = 0; k < definitions.size(); k = end) {
        end = writer.end_of_group(k);
        calls.push_back(
            end == k + 1
                ? writer.add_definition(k, definitions[k].unchosen.has_value())
                : writer.add_group(k, end, caller + "_if_chosen_" + std::to_string(groups++)));
    }
    Calls parted = in_parts(caller, std::move(calls),
                            [&](const Uses& uses) { return writer.parameters(uses); });
    CpfFunctions result = std::move(writer.result);
    result.calls = std::move(parted.statements);
    append(result.functions, std::move(parted.parts));
    return result;
}

struct ConditionKind {
    std::string word;      // "precondition"
    std::string function;  // of all: "violated_precondition"
    std::string comment;
    ir::Scalar type;        // of its result
    tree::Expression none;  // the result where there are none
    std::string gathered;   // the class that adds them up (rddl/step/conditions.hpp)
    std::string result;     // its member that says what they say
    std::vector<Storage> records;
};

const std::string conditions_name = "conditions";

// "if (conditions.go_on()) conditions.add(3, precondition_3(state));"
tree::Statement add_condition(const ConditionKind& kind, std::size_t k,
                              tree::Expression condition) {
    tree::Expressions arguments;
    if (kind.word == "precondition") arguments.push_back(tree::number(k));
    arguments.push_back(std::move(condition));
    tree::Statement add{tree::call(conditions_name + ".add", std::move(arguments))};
    if (kind.word == "termination") return add;
    return {tree::If{tree::call(conditions_name + ".go_on", {}), std::move(add)}};
}

// Whether the instance makes it true of every state and action; a termination false.
bool is_idle(const ir::Program& program, const ConditionKind& kind,
             const ir::Computation& computation) {
    const bool idle = kind.word != "termination";
    return computation.body.empty() && ir::constant<bool>(program, computation.value) == idle;
}

tree::Block conditions(const Unit& unit, const ConditionKind& kind,
                       const std::vector<ir::Computation>& computations) {
    Uses all;
    std::vector<Call> calls;
    tree::Block functions;
    for (std::size_t k = 0; k < computations.size(); ++k) {
        const ir::Computation& computation = computations[k];
        if (is_idle(unit.program, kind, computation)) continue;
        FunctionBody body(unit, level + 1);
        body.block(computation.body);
        body.return_value(computation.value);
        // No caller has tables for conditions; those that need some have their own.
        Uses uses = body.uses();
        const bool has_scratch = uses.records.erase(Storage::Scratch) > 0;
        all.add(uses);
        const std::vector<Parameter> parameters = only_used(parameters_of(simulator_records, uses));
        const std::string name = kind.word + "_" + std::to_string(k);
        calls.push_back({add_condition(kind, k,
                                       tree::call(name + (parameters.empty() ? "<L>" : ""),
                                                  arguments(parameters))),
                         uses});
        functions.push_back(function(lane_type_of(ir::Scalar::Bool), name, parameters,
                                     body_of(unit, body, computation.span, has_scratch),
                                     comment(unit.sources.text_on_one_line(computation.span),
                                             unit.where(computation.span))));
    }
    const std::string gathered = "rddl::" + kind.gathered + "<L>";
    Calls parted = in_parts(kind.word + "s", std::move(calls), [&](const Uses& uses) {
        std::vector<Parameter> parameters = parameters_of(simulator_records, uses);
        parameters.insert(parameters.begin(), {gathered + "&", conditions_name, true});
        return parameters;
    });
    std::string others;
    if (!functions.empty() && functions.size() < computations.size())
        others =
            kind.word == "termination" ? " The others never hold." : " The others always hold.";
    tree::Block body;
    if (functions.empty()) {
        body.push_back({tree::Return{kind.none}});
    } else {
        const bool takes_context = kind.word != "termination";
        all.context |= takes_context;
        const tree::Expression object{tree::Declared{gathered, conditions_name}};
        body.push_back({takes_context ? tree::call(object, {word("context")}) : object});
        append(body, std::move(parted.statements));
        body.push_back({tree::Return{tree::call(conditions_name + "." + kind.result, {})}});
    }
    tree::Block result = {function(lane_type_of(kind.type), kind.function,
                                   parameters_of(kind.records, all), std::move(body),
                                   kind.comment + others)};
    append(result, std::move(functions));
    append(result, std::move(parted.parts));
    return result;
}

std::string printed(tree::Statement function) {
    return tree::print({std::move(function)}, level);
}

}  // namespace

tree::Block assignments(const Unit& unit, Storage storage, const std::string& record) {
    tree::Block result;
    for (std::size_t index = 0; index < unit.program.buffers.size(); ++index) {
        const ir::Buffer& buffer = unit.program.buffers[index];
        if (buffer.storage != storage || buffer.values.empty()) continue;
        const std::string target = record + "." + unit.names.buffers[index];
        const std::string& table = unit.names.initial[index];
        tree::Expression value =
            word(table.empty() ? literal(buffer.values[0], unit.program.real) : table);
        result.push_back(
            buffer.shape.empty()
                ? tree::assign(target, std::move(value))
                : tree::Statement{tree::call("rddl::assign", {word(target), std::move(value)})});
    }
    return result;
}

std::string record_aliases(const Unit& unit, const std::vector<std::string>& records) {
    tree::Block aliases;
    for (const std::string& record : records) aliases.push_back(alias(unit, record, record));
    return print(aliases, level);
}

// The values that are given, then what is drawn.
std::string reset_function(const Unit& unit) {
    tree::Block values = assignments(unit, Storage::State, "state");
    tree::Block draws;
    FunctionBody body(unit, level + 1);
    for (const ir::Definition& definition : unit.program.reset) {
        body.block(definition.body);
        append(draws, located(unit, std::exchange(body.statements(), {}), definition.span));
    }
    Uses uses = body.uses();
    const bool has_scratch = uses.has(Storage::Scratch);
    if (!values.empty()) uses.records.insert(Storage::State);
    uses.stored.insert(Storage::State);
    const std::vector<Parameter> parameters = parameters_of({Storage::State}, uses);
    if (draws.empty()) return printed(function("void", "reset", parameters, std::move(values)));
    tree::Block statements = prologue(uses, has_scratch);
    statements.push_back({tree::call("initial_state", {word("state")})});
    append(statements, std::move(draws));
    return tree::print({function("void", "initial_state", {parameters.front()}, std::move(values)),
                        function("void", "reset", parameters, std::move(statements),
                                 "With what is drawn at random.")},
                       level);
}

std::string reward_function(const Unit& unit) {
    const ir::Computation& reward = unit.program.reward;
    FunctionBody body(unit, level + 1);
    body.block(reward.body);
    body.return_value(reward.value);
    return printed(
        function(lane_type_of(ir::Scalar::Real), "reward",
                 parameters_of({Storage::State, Storage::Action, Storage::Scratch, Storage::Next},
                               body.uses()),
                 body_of(unit, body, reward.span)));
}

std::string condition_functions(const Unit& unit) {
    const ir::Program& program = unit.program;
    const tree::Expression none = tree::braces(lane_type_of(ir::Scalar::Int), {word("-1")});
    tree::Block functions =
        conditions(unit,
                   {"termination",
                    "terminal",
                    "Whether one of the terminations holds, so that the episode ends.",
                    ir::Scalar::Bool,
                    word("false"),
                    "Terminations",
                    "hold",
                    {Storage::State}},
                   program.terminations);
    append(functions, conditions(unit,
                                 {"invariant",
                                  "violates_invariant",
                                  "Whether the state breaks one of the invariants.",
                                  ir::Scalar::Bool,
                                  word("false"),
                                  "Invariants",
                                  "violated",
                                  {Storage::State}},
                                 program.invariants));
    append(functions, conditions(unit,
                                 {"precondition",
                                  "violated_precondition",
                                  "The first precondition that the action violates, or -1.",
                                  ir::Scalar::Int,
                                  none,
                                  "Preconditions",
                                  "first_violated",
                                  {Storage::State, Storage::Action}},
                                 program.preconditions));
    return print(functions, level);
}

StepFunctions step_functions(const Unit& unit) {
    CpfFunctions cpfs =
        cpf_functions(unit, "step", unit.program.step, unit.names.functions, Owner::Simulator);
    cpfs.uses.stored.insert({Storage::Scratch, Storage::Next, Storage::Observation});
    tree::Block body;
    if (std::exchange(cpfs.uses.numbers, false))
        body.push_back(
            {tree::call(tree::declared("const " + step_numbers, "numbers"), {word("context")})});
    if (std::exchange(cpfs.uses.normals, false))
        body.push_back(
            {tree::call(tree::declared("const " + step_normals, "normals"), {word("context")})});
    append(body, std::move(cpfs.calls));
    return {printed(function("void", "step", parameters_of(simulator_records, cpfs.uses),
                             std::move(body))),
            print(cpfs.functions, level)};
}

std::string moderate_test(const Unit& unit) {
    Uses uses;
    std::optional<tree::Expression> all;
    for (const ir::BufferId id : ir::reals_taken_for_moderate(unit.program)) {
        const Storage storage = unit.program[id].storage;
        uses.records.insert(storage);
        const std::string element =
            words_of(storage).parameter + "." + unit.names.buffers[id.index];
        tree::Expressions table = {word(element)};
        if (const std::string& sliding = unit.names.sliding_buffers[id.index]; !sliding.empty())
            table.push_back(word(words_of(storage).parameter + "." + sliding));
        const tree::Expression test = tree::call("rddl::is_moderate<L>", std::move(table));
        all = all ? tree::operation(plain_operator(Operator::And), {*all, test}) : test;
    }
    std::vector<Parameter> parameters = parameters_of({Storage::State, Storage::Action}, uses);
    parameters.pop_back();
    return printed(function(lane_type_of(ir::Scalar::Bool), "is_for", parameters,
                            {{tree::Return{all.value_or(word("true"))}}}));
}

std::string policy(const Unit& unit) {
    if (!unit.program.policy) return "";
    CpfFunctions cpfs = cpf_functions(unit, "act", unit.program.policy->act,
                                      unit.names.policy_functions, Owner::Policy);
    cpfs.uses.stored.insert({Storage::Scratch, Storage::Action, Storage::NextMemory});
    tree::Block initial = assignments(unit, Storage::Memory, "memory");
    Uses memory;
    memory.stored.insert(Storage::Memory);
    if (!initial.empty()) memory.records.insert(Storage::Memory);
    return fill_slots(
        templates::policy,
        {{"name", comment_text(unit.program.policy->name)},
         {"place", unit.where(unit.program.policy->span)},
         {"alias", printed(alias(unit, "Memory", "PolicyMemory"))},
         {"reset", printed(function("void", "reset", {record_parameter(Storage::Memory, memory)},
                                    std::move(initial)))},
         {"act", printed(function("void", "act", parameters_of(policy_records(unit), cpfs.uses),
                                  std::move(cpfs.calls)))},
         {"cpfs", print(cpfs.functions, level)}});
}

}  // namespace rddlc::cpp
