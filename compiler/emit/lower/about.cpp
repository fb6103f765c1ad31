// Over 400 lines: one class, which describes a program in the order of simulator.h.
#include "emit/lower/about.hpp"

#include "emit/cpp/literals.hpp"
#include "emit/cpp/print.hpp"
#include "emit/lower/constants.hpp"
#include "emit/lower/functions.hpp"
#include "emit/lower/moderate.hpp"
#include "emit/lower/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::cpp {
namespace {

// Values of one constant that a compiler computes: clang takes no more than 2^20 steps for it, g++
// 2^18 turns of a loop.
constexpr std::size_t most_computed = 100'000;

using tree::braces;
using tree::call;
using tree::declared;
using tree::Expression;
using tree::number;
using tree::word;

std::string role_constant(Role role) {
    switch (role) {
        case Role::NonFluent:
            return "RDDL_NON_FLUENT";
        case Role::State:
            return "RDDL_STATE";
        case Role::Action:
            return "RDDL_ACTION";
        case Role::Interm:
            return "RDDL_INTERM";
        case Role::Derived:
            return "RDDL_DERIVED";
        case Role::Observ:
            break;
    }
    return "RDDL_OBSERVATION";
}

std::string scalar_constant(ir::Scalar scalar) {
    switch (scalar) {
        case ir::Scalar::Bool:
            return "RDDL_BOOL";
        case ir::Scalar::Int:
            return "RDDL_INT";
        case ir::Scalar::Real:
            break;
    }
    return "RDDL_REAL";
}

// The record that holds the fluents of a role; empty if there is no such record.
std::string record_of(Role role) {
    switch (role) {
        case Role::State:
            return "State";
        case Role::Action:
            return "Action";
        case Role::Observ:
            return "Observation";
        case Role::NonFluent:
        case Role::Interm:
        case Role::Derived:
            break;
    }
    return "";
}

// Writes one table after the other; equal small tables are shared.
class Describer {
  public:
    Describer(const Unit& unit, const DetailsUnit* details)
        : unit_(unit), details_(details), scope_(&unit.names.file) {}

    std::string describe() {
        files();
        types();
        fluents();
        constants();
        const ir::Program& program = unit_.program;
        conditions("preconditions", program.preconditions);
        conditions("invariants", program.invariants);
        conditions("terminations", program.terminations);
        default_action();
        problem();
        policy();
        sites();
        step_details();
        return tree::print(definitions_, 0);
    }

  private:
    void add(const std::string& type, const std::string& name, Expression value) {
        definitions_.push_back(tree::assign(declared(type, name), std::move(value)));
    }

    Expression source(Span span) const {
        const Position position = unit_.sources.position(span);
        return braces("",
                      {word(files_.at(span.file)), number(position.line), number(position.column)});
    }

    // `name[] = { rows };`, with the columns' names above.
    void rows(const std::string& type, const std::string& name, tree::Expressions rows,
              const std::string& columns = "") {
        if (rows.empty()) return;
        add("inline constexpr " + type, name + "[]", braces("", std::move(rows)));
        definitions_.back().comment = columns;
    }

    // The files that descriptions refer to.
    void files() {
        std::set<FileId> used;
        for (const ir::Fluent& fluent : unit_.program.fluents) used.insert(fluent.span.file);
        for (const ir::Site& site : unit_.program.sites) used.insert(site.span.file);
        if (unit_.program.policy) used.insert(unit_.program.policy->span.file);
        for (const auto* conditions : {&unit_.program.preconditions, &unit_.program.invariants,
                                       &unit_.program.terminations}) {
            for (const ir::Computation& condition : *conditions) used.insert(condition.span.file);
        }
        for (FileId file : used) {
            files_[file] = scope_.claim("source_file");
            add("inline constexpr const char*", files_[file],
                tree::text(unit_.sources[file].path()));
        }
    }

    void types() {
        tree::Expressions table;
        for (std::size_t index = 0; index < unit_.program.types.size(); ++index) {
            const ir::ObjectType& type = unit_.program.types[index];
            std::string objects = "nullptr";
            if (!type.objects.empty()) {
                objects = scope_.claim(type.name, marks::objects);
                tree::Expressions names;
                for (const std::string& name : type.objects) names.push_back(tree::text(name));
                add("inline constexpr const char*", objects + "[]", braces("", std::move(names)));
            }
            table.push_back(
                braces("", {tree::text(type.name), word(objects), word(unit_.names.counts[index]),
                            word(type.enumerated ? "1" : "0")}));
        }
        rows("rddl_type", "types", std::move(table));
    }

    // The table of a fluent's parameter types.
    std::string parameter_types(const ir::Fluent& fluent) {
        if (fluent.parameter_types.empty()) return "nullptr";
        std::string& name = parameter_types_[fluent.parameter_types];
        if (!name.empty()) return name;
        std::string wish;
        tree::Expressions numbers;
        for (std::uint32_t type : fluent.parameter_types) {
            wish += (wish.empty() ? "" : "_") + unit_.program.types[type].name;
            numbers.push_back(number(type));
        }
        name = scope_.claim(wish, marks::parameter_types);
        add("inline constexpr std::int32_t", name + "[]", braces("", std::move(numbers)));
        return name;
    }

    // nullptr where nothing bounds the fluent.
    std::string bounds(const ir::Fluent& fluent, Mark which, const std::vector<double>& values) {
        const bool unbounded = std::ranges::all_of(values, [](double v) { return std::isinf(v); });
        if (values.empty() || (unbounded && are_infinite(fluent))) return "nullptr";
        const std::string name = scope_.claim(fluent.name, which);
        const std::string type = "std::array<double, " + std::to_string(values.size()) + ">";
        const std::vector<ir::Value> entries(values.begin(), values.end());
        if (entries.size() > 1 && are_equal(entries)) {
            const std::string repeated = "rddl::repeated<" + std::to_string(values.size()) + ">";
            const Expression value = word(literal(entries.front()));
            if (entries.size() <= most_computed)
                add("inline constexpr auto", name, call(repeated, {value}));
            else
                add("inline const auto", name,
                    call("rddl::made_at_start", {word(repeated), value}));
        } else {
            const auto count = static_cast<std::int64_t>(values.size());
            definitions_.push_back(table(type, name, std::span(&count, 1), entries));
        }
        return name + ".data()";
    }

    // Both bounds of all groundings: the fluent is not bounded at all.
    static bool are_infinite(const ir::Fluent& fluent) {
        const auto infinite = [](double v) {
            return std::isinf(v);
        };
        return std::ranges::all_of(*fluent.lower, infinite) &&
               std::ranges::all_of(*fluent.upper, infinite);
    }

    std::string offset(std::size_t index) const {
        const ir::Fluent& fluent = unit_.program.fluents[index];
        if (fluent.role == Role::Interm || fluent.role == Role::Derived)
            return offset_in_details(index);
        const std::string record = record_of(fluent.role);
        if (record.empty() || !fluent.buffer) return "-1";
        return "offsetof(" + record + "<rddl::Scalar>, " +
               unit_.names.buffers[fluent.buffer->index] + ")";
    }

    std::string offset_in_details(std::size_t index) const {
        if (!details_) return "-1";
        return offset_in_details(*details_->unit.program.fluents[index].buffer);
    }
    std::string offset_in_details(ir::BufferId buffer) const {
        return "offsetof(details::Observation<rddl::Scalar>, " +
               details_->unit.names.buffers[buffer.index] + ")";
    }

    void fluents() {
        tree::Expressions table;
        for (std::size_t index = 0; index < unit_.program.fluents.size(); ++index) {
            const ir::Fluent& fluent = unit_.program.fluents[index];
            std::int64_t count = 1;
            for (std::uint32_t type : fluent.parameter_types) {
                count *= static_cast<std::int64_t>(unit_.program.types[type].objects.size());
            }
            const int range = fluent.object_type ? static_cast<int>(*fluent.object_type) : -1;
            const std::string types = parameter_types(fluent);
            const std::string lower = bounds(fluent, marks::lower, *fluent.lower);
            const std::string upper = bounds(fluent, marks::upper, *fluent.upper);
            table.push_back(
                braces("", {tree::text(fluent.name), word(role_constant(fluent.role)),
                            word(scalar_constant(fluent.scalar)), number(range),
                            number(fluent.parameter_types.size()), word(types), number(count),
                            word(offset(index)), word(lower), word(upper), source(fluent.span)}));
        }
        rows("rddl_fluent", "fluents", std::move(table),
             "name, role, scalar, range type, rank, parameter types, count, offset, lower, upper, "
             "source");
    }

    // The values of the non-fluents.
    void constants() {
        tree::Bracketed list{word(""), tree::Brackets::Curly, {}};
        for (std::size_t index = 0; index < unit_.program.fluents.size(); ++index) {
            const ir::Fluent& fluent = unit_.program.fluents[index];
            if (fluent.role != Role::NonFluent) continue;
            list.items.push_back(constants_of(unit_, index, scope_, definitions_));
            list.comments.push_back(comment_text(fluent.name));
        }
        if (!list.items.empty())
            add("inline constexpr rddl::Constants", "constants[]", {std::move(list)});
    }

    void conditions(const std::string& name, const std::vector<ir::Computation>& conditions) {
        tree::Expressions table;
        for (const ir::Computation& condition : conditions)
            table.push_back(braces("", {tree::text(unit_.sources.text_on_one_line(condition.span)),
                                        source(condition.span)}));
        rows("rddl_condition", name, std::move(table));
    }

    bool has(ir::Storage storage) const {
        return std::ranges::any_of(unit_.program.buffers, [&](const ir::Buffer& buffer) {
            return buffer.storage == storage;
        });
    }

    void default_action() {
        if (!has(ir::Storage::Action)) return;
        tree::Block body = {{tree::braces("Action<rddl::Scalar> action", {})}};
        tree::append(body, assignments(unit_, ir::Storage::Action, "action"));
        body.push_back({tree::Return{word("action")}});
        const bool computed = count_of(ir::Storage::Action) <= most_computed;
        Expression make{tree::Lambda{{}, std::move(body), false, computed}};
        if (computed)
            add("inline constexpr Action<rddl::Scalar>", "default_action", std::move(make));
        else
            add("inline const Action<rddl::Scalar>", "default_action",
                call("rddl::made_at_start", {std::move(make)}));
    }

    std::size_t count_of(ir::Storage storage) const {
        std::size_t count = 0;
        for (const ir::Buffer& buffer : unit_.program.buffers)
            if (buffer.storage == storage) count += static_cast<std::size_t>(buffer.count());
        return count;
    }

    std::string size_of(ir::Storage storage, const std::string& record) const {
        return has(storage) ? "sizeof(" + record + "<rddl::Scalar>)" : "0";
    }

    void problem() {
        const ir::Program& program = unit_.program;
        const std::string state_size = size_of(ir::Storage::State, "State");
        const bool partial = program.partially_observed();
        tree::Expressions fields;
        const auto set = [&](const std::string& name, Expression value) {
            fields.push_back(tree::initialiser(name, std::move(value)));
        };
        const auto field = [&](const std::string& name, const std::string& value) {
            set(name, word(value));
        };
        const auto table = [&](const std::string& name, const std::string& count_name,
                               std::size_t count) {
            field(name, count > 0 ? name : "nullptr");
            field(count_name, std::to_string(count));
        };
        field("struct_size", "sizeof(rddl_problem)");
        field("type_size", "sizeof(rddl_type)");
        field("fluent_size", "sizeof(rddl_fluent)");
        field("condition_size", "sizeof(rddl_condition)");
        set("domain", tree::text(program.domain_name));
        set("instance", tree::text(program.instance_name));
        table("types", "type_count", program.types.size());
        table("fluents", "fluent_count", program.fluents.size());
        field("state_size", state_size);
        field("action_size", size_of(ir::Storage::Action, "Action"));
        field("observation_size",
              partial ? size_of(ir::Storage::Observation, "Observation") : state_size);
        field("interm_size", details_ ? std::to_string(ir::interm_size(details_->details)) : "0");
        field("partially_observed", partial ? "1" : "0");
        field("stochastic", ir::is_stochastic(program) ? "1" : "0");
        field("default_action", has(ir::Storage::Action) ? "&default_action" : "nullptr");
        field("horizon", std::to_string(program.horizon));
        field("discount", literal(program.discount));
        field("max_nondef_actions", std::to_string(program.max_nondef_actions.value_or(-1)));
        table("preconditions", "precondition_count", program.preconditions.size());
        table("invariants", "invariant_count", program.invariants.size());
        table("terminations", "termination_count", program.terminations.size());
        field("fingerprint", fmt::format("0x{:016x}", program.fingerprint));
        add("inline constexpr rddl_problem", "problem", braces("", std::move(fields)));
    }

    void policy() {
        const std::optional<ir::Policy>& policy = unit_.program.policy;
        if (!policy) return;
        const std::string stochastic = ir::is_policy_stochastic(unit_.program) ? "1" : "0";
        const std::string size = size_of(ir::Storage::Memory, "PolicyMemory");
        add("inline constexpr rddl_policy", "policy",
            braces("", {tree::initialiser("struct_size", word("sizeof(rddl_policy)")),
                        tree::initialiser("name", tree::text(policy->name)),
                        tree::initialiser("source", source(policy->span)),
                        tree::initialiser("memory_size", word(size)),
                        tree::initialiser("stochastic", word(stochastic))}));
    }

    // The table of variables that are in scope at a site, or that a precondition begins with.
    std::string scope_table(const ir::Program& program, const std::vector<ir::VariableId>& scope) {
        if (scope.empty()) return "{}";
        tree::Expressions variables;
        ScopeKey key;
        for (ir::VariableId id : scope) {
            const ir::Variable& variable = program[id];
            variables.push_back(
                braces("", {tree::text(variable.name),
                            word("&types[" + std::to_string(*variable.type) + "]")}));
            key.emplace_back(variable.name, *variable.type);
        }
        std::string& name = scope_tables_[key];
        if (!name.empty()) return name;
        std::string wish;
        for (ir::VariableId id : scope) wish += (wish.empty() ? "" : "_") + program[id].name;
        name = scope_.claim(wish, marks::scope);
        add("inline constexpr rddl::SiteVariable", name + "[]", braces("", std::move(variables)));
        return name;
    }

    void sites() {
        tree::Expressions table;
        for (const ir::Site& site : unit_.program.sites) {
            table.push_back(braces("", {source(site.span), tree::text(site.what),
                                        word(scope_table(unit_.program, site.scope))}));
        }
        rows("rddl::Site", "sites", std::move(table));
    }

    void step_details() {
        if (!details_) return;
        tree::Expressions table;
        for (const ir::ConditionTable& condition : details_->details.preconditions)
            table.push_back(
                braces("", {word(offset_in_details(condition.holds)),
                            word(scope_table(details_->details.program, condition.scope))}));
        const std::string places = table.empty() ? "{}" : "condition_places";
        rows("rddl::ConditionPlaces", "condition_places", std::move(table));
        add("inline constexpr rddl::Details", "step_details",
            call("rddl::details_of<Simulator, details::Step>",
                 {word("problem.interm_size"), word(places)}));
    }

    const Unit& unit_;
    const DetailsUnit* details_;
    Scope scope_;
    tree::Block definitions_;
    std::map<FileId, std::string> files_;
    std::map<std::vector<std::uint32_t>, std::string> parameter_types_;
    using ScopeKey = std::vector<std::pair<std::string, std::uint32_t>>;
    std::map<ScopeKey, std::string> scope_tables_;
};

}  // namespace

std::string about(const Unit& unit, const DetailsUnit* details) {
    return Describer(unit, details).describe();
}

std::string table_definition(const Unit& unit, bool has_details) {
    const bool has_constants =
        std::ranges::count(unit.program.fluents, Role::NonFluent, &ir::Fluent::role) > 0;
    tree::Expressions parts = {word("about::problem"),
                               word(unit.program.sites.empty() ? "{}" : "about::sites"),
                               word(has_constants ? "about::constants" : "{}")};
    if (unit.program.policy || has_details)
        parts.push_back(word(unit.program.policy ? "&about::policy" : "nullptr"));
    if (has_details) parts.push_back(word("&about::step_details"));
    tree::Block definitions;
    if (unit.has_packs()) {
        const std::string real = unit.program.real == RealType::Float ? ", float" : "";
        const std::string packed = fmt::format("rddl::{}<{}, about::problem, {}{}>",
                                               unit.has_byte_ints() ? "PackedByteInts" : "Packed",
                                               type_for_packs(unit), unit.options.lane_count, real);
        definitions.push_back(tree::assign("using Packed", word(packed)));
    }
    definitions.push_back({braces("constexpr rddl::About description", std::move(parts))});
    const std::string engines = unit.has_packs() ? "Engine, Packed" : "Engine";
    definitions.push_back({call("static const rddl::SimulatorTable<" + engines + "> table",
                                {word("description"), call("Engine", {})})});
    return tree::print(definitions, 1);
}

}  // namespace rddlc::cpp
