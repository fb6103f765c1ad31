// Over 400 lines: one class, which describes a program in the order of simulator.h.
#include "emit/about.hpp"

#include "emit/constants.hpp"
#include "emit/functions.hpp"
#include "emit/layout.hpp"
#include "emit/literals.hpp"
#include "emit/moderate.hpp"
#include "emit/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

namespace rddlc::cpp {
namespace {

// Values of one constant that a compiler computes: clang takes no more than 2^20 steps for it, g++
// 2^18 turns of a loop.
constexpr std::size_t most_computed = 100'000;

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

// The record that a role's fluents lie in; empty if in none.
std::string record_of(Role role) {
    switch (role) {
        case Role::State:
            return "State";
        case Role::Action:
            return "Action";
        case Role::Observ:
            return "Observation";
        default:
            return "";
    }
}

// A string literal inside a row; in pieces under each other if it is long.
std::string on_lines(std::string_view text) {
    constexpr std::size_t width = 85;
    std::string result;
    while (text.size() > width) {
        const std::size_t blank = text.rfind(' ', width - 1);
        const std::size_t end = blank == std::string_view::npos ? text.size() : blank + 1;
        result += literal(text.substr(0, end)) + "\n" + std::string(indentation + 1, ' ');
        text.remove_prefix(end);
    }
    return result + literal(text);
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
        return with_joined_regions(std::move(text_));
    }

  private:
    // Definitions of one line stand together.
    void add(const std::string& definition) {
        const bool is_line = std::ranges::count(definition, '\n') == 1;
        text_ += (text_.empty() || (is_line && after_line_) ? "" : "\n") + definition;
        after_line_ = is_line;
    }

    std::string source(Span span) const {
        const Position position = unit_.sources.position(span);
        return "{" + files_.at(span.file) + ", " + std::to_string(position.line) + ", " +
               std::to_string(position.column) + "}";
    }

    // `name[] = { rows };`, with the columns' names above.
    void rows(const std::string& type, const std::string& name,
              const std::vector<std::vector<std::string>>& rows, const std::string& columns = "") {
        if (rows.empty()) return;
        std::string text = "inline constexpr " + type + " " + name + "[] = {\n";
        if (!columns.empty()) text += std::string(indentation, ' ') + "// " + columns + "\n";
        for (const auto& row : rows) {
            for (const std::string& line : fill_call("{", row, "},", indentation)) {
                text += std::string(indentation, ' ') + line + "\n";
            }
        }
        add("// clang-format off\n" + text + "};\n// clang-format on\n");
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
            add("inline constexpr const char* " + files_[file] + " = " +
                literal(std::string_view(unit_.sources[file].path())) + ";\n");
        }
    }

    void types() {
        std::vector<std::vector<std::string>> table;
        for (std::size_t index = 0; index < unit_.program.types.size(); ++index) {
            const ir::ObjectType& type = unit_.program.types[index];
            std::string objects = "nullptr";
            if (!type.objects.empty()) {
                objects = scope_.claim(type.name, marks::objects);
                std::vector<std::string> names;
                for (const std::string& name : type.objects) {
                    names.push_back(literal(std::string_view(name)));
                }
                add(list("inline constexpr const char* " + objects + "[]", names));
            }
            table.push_back({literal(std::string_view(type.name)), objects,
                             unit_.names.counts[index], type.enumerated ? "1" : "0"});
        }
        rows("rddl_type", "types", table);
    }

    // The table of a fluent's parameter types.
    std::string parameter_types(const ir::Fluent& fluent) {
        if (fluent.parameter_types.empty()) return "nullptr";
        std::string& name = parameter_types_[fluent.parameter_types];
        if (!name.empty()) return name;
        std::string wish;
        std::vector<std::string> numbers;
        for (std::uint32_t type : fluent.parameter_types) {
            wish += (wish.empty() ? "" : "_") + unit_.program.types[type].name;
            numbers.push_back(std::to_string(type));
        }
        name = scope_.claim(wish, marks::parameter_types);
        add(list("inline constexpr std::int32_t " + name + "[]", numbers));
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
            const std::string count = std::to_string(values.size());
            const std::string value = literal(entries.front());
            const bool computed = entries.size() <= most_computed;
            const std::string head =
                (computed ? "inline constexpr auto " : "inline const auto ") + name + " =";
            const std::string table =
                computed ? "rddl::repeated<" + count + ">(" + value + ");\n"
                         : "rddl::made_at_start(rddl::repeated<" + count + ">, " + value + ");\n";
            const bool fits = head.size() + table.size() <= line_width;
            add(head + (fits ? " " : "\n    ") + table);
        } else {
            const auto count = static_cast<std::int64_t>(values.size());
            add(table("inline constexpr " + type + " " + name, std::span(&count, 1), entries));
        }
        return name + ".data()";
    }

    // Both bounds of all groundings: the fluent is not bounded at all.
    static bool are_infinite(const ir::Fluent& fluent) {
        const auto infinite = [](double v) {
            return std::isinf(v);
        };
        return std::ranges::all_of(fluent.lower, infinite) &&
               std::ranges::all_of(fluent.upper, infinite);
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
        std::vector<std::vector<std::string>> table;
        for (std::size_t index = 0; index < unit_.program.fluents.size(); ++index) {
            const ir::Fluent& fluent = unit_.program.fluents[index];
            std::int64_t count = 1;
            for (std::uint32_t type : fluent.parameter_types) {
                count *= static_cast<std::int64_t>(unit_.program.types[type].objects.size());
            }
            const int range = fluent.object_type ? static_cast<int>(*fluent.object_type) : -1;
            table.push_back({literal(std::string_view(fluent.name)), role_constant(fluent.role),
                             scalar_constant(fluent.scalar), std::to_string(range),
                             std::to_string(fluent.parameter_types.size()), parameter_types(fluent),
                             std::to_string(count), offset(index),
                             bounds(fluent, marks::lower, fluent.lower),
                             bounds(fluent, marks::upper, fluent.upper), source(fluent.span)});
        }
        rows("rddl_fluent", "fluents", table,
             "name, role, scalar, range type, rank, parameter types, count, offset, lower, upper, "
             "source");
    }

    // Of the non-fluents.
    void constants() {
        std::vector<CommentedLine> lines;
        for (std::size_t index = 0; index < unit_.program.fluents.size(); ++index) {
            const ir::Fluent& fluent = unit_.program.fluents[index];
            if (fluent.role != Role::NonFluent) continue;
            const ConstantText text = constants_of(unit_, index, scope_);
            if (!text.tables.empty()) add(text.tables);
            lines.push_back(
                {std::string(indentation, ' ') + text.value + ",", comment_text(fluent.name)});
        }
        if (lines.empty()) return;
        add("// clang-format off\ninline constexpr rddl::Constants constants[] = {\n" +
            with_comments(lines) + "};\n// clang-format on\n");
    }

    void conditions(const std::string& name, const std::vector<ir::Computation>& conditions) {
        std::vector<std::vector<std::string>> table;
        for (const ir::Computation& condition : conditions) {
            const std::string text = unit_.sources.text_on_one_line(condition.span);
            table.push_back({on_lines(text), source(condition.span)});
        }
        rows("rddl_condition", name, table);
    }

    bool has(ir::Storage storage) const {
        return std::ranges::any_of(unit_.program.buffers, [&](const ir::Buffer& buffer) {
            return buffer.storage == storage;
        });
    }

    void default_action() {
        if (!has(ir::Storage::Action)) return;
        const std::string make =
            "[] {\n"
            "    Action<rddl::Scalar> action{};\n" +
            assignments(unit_, ir::Storage::Action, "action", 1) +
            "    return action;\n"
            "}";
        const bool computed = count_of(ir::Storage::Action) <= most_computed;
        add(computed ? "inline constexpr Action<rddl::Scalar> default_action = " + make + "();\n"
                     : "inline const Action<rddl::Scalar> default_action = rddl::made_at_start(" +
                           make + ");\n");
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
        std::string text = "inline constexpr rddl_problem problem = {\n";
        const auto field = [&](const std::string& name, const std::string& value) {
            text += "    ." + name + " = " + value + ",\n";
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
        field("domain", literal(std::string_view(program.domain_name)));
        field("instance", literal(std::string_view(program.instance_name)));
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
        add(text + "};\n");
    }

    void policy() {
        const std::optional<ir::Policy>& policy = unit_.program.policy;
        if (!policy) return;
        add("inline constexpr rddl_policy policy = {\n"
            "    .struct_size = sizeof(rddl_policy),\n"
            "    .name = " +
            literal(std::string_view(policy->name)) + ",\n    .source = " + source(policy->span) +
            ",\n    .memory_size = " + size_of(ir::Storage::Memory, "PolicyMemory") +
            ",\n    .stochastic = " + (ir::is_policy_stochastic(unit_.program) ? "1" : "0") +
            ",\n};\n");
    }

    // The table of variables that are in scope at a site, or that a precondition begins with.
    std::string scope_table(const ir::Program& program, const std::vector<ir::VariableId>& scope) {
        if (scope.empty()) return "{}";
        std::vector<std::string> variables;
        std::string key;
        for (ir::VariableId id : scope) {
            const ir::Variable& variable = program[id];
            variables.push_back("{" + literal(std::string_view(variable.name)) + ", &types[" +
                                std::to_string(*variable.type) + "]}");
            key += variables.back();
        }
        std::string& name = scope_tables_[key];
        if (!name.empty()) return name;
        std::string wish;
        for (ir::VariableId id : scope) wish += (wish.empty() ? "" : "_") + program[id].name;
        name = scope_.claim(wish, marks::scope);
        add(list("inline constexpr rddl::SiteVariable " + name + "[]", variables));
        return name;
    }

    void sites() {
        std::vector<std::vector<std::string>> table;
        for (const ir::Site& site : unit_.program.sites) {
            table.push_back({source(site.span), literal(std::string_view(site.what)),
                             scope_table(unit_.program, site.scope)});
        }
        rows("rddl::Site", "sites", table);
    }

    void step_details() {
        if (!details_) return;
        std::vector<std::vector<std::string>> table;
        for (const ir::ConditionTable& condition : details_->details.preconditions)
            table.push_back({offset_in_details(condition.holds),
                             scope_table(details_->details.program, condition.scope)});
        rows("rddl::ConditionPlaces", "condition_places", table);
        add("inline constexpr rddl::Details step_details =\n"
            "    rddl::details_of<Simulator, details::Step>(problem.interm_size, " +
            std::string(table.empty() ? "{}" : "condition_places") + ");\n");
    }

    const Unit& unit_;
    const DetailsUnit* details_;
    Scope scope_;
    std::string text_;
    bool after_line_ = false;
    std::map<FileId, std::string> files_;
    std::map<std::vector<std::uint32_t>, std::string> parameter_types_;
    std::map<std::string, std::string> scope_tables_;
};

}  // namespace

std::string about(const Unit& unit, const DetailsUnit* details) {
    return Describer(unit, details).describe();
}

namespace {

// Policies and functions of whole tables work on one environment at a time.
bool has_packs(const Unit& unit) {
    return unit.options.lane_count > 1 && !unit.program.policy &&
           std::ranges::none_of(ir::blocks_of(unit.program),
                                [](const ir::Block* block) { return ir::calls_functions(*block); });
}

}  // namespace

std::string table_definition(const Unit& unit, bool has_details) {
    const bool has_constants =
        std::ranges::count(unit.program.fluents, Role::NonFluent, &ir::Fluent::role) > 0;
    std::vector<std::string> parts = {"about::problem",
                                      unit.program.sites.empty() ? "{}" : "about::sites",
                                      has_constants ? "about::constants" : "{}"};
    if (unit.program.policy || has_details)
        parts.push_back(unit.program.policy ? "&about::policy" : "nullptr");
    if (has_details) parts.push_back("&about::step_details");
    const std::string engines = has_packs(unit) ? "Engine, Packed" : "Engine";
    std::string text;
    if (has_packs(unit)) {
        const bool floats = unit.program.real == RealType::Float;
        text += fmt::format("    using Packed = rddl::Packed<{}, about::problem, {}{}>;\n",
                            stepping_type(unit), unit.options.lane_count, floats ? ", float" : "");
    }
    for (const std::string& line :
         fill_call("constexpr rddl::About description{", parts, "};", indentation))
        text += std::string(indentation, ' ') + line + "\n";
    text +=
        "    static const rddl::SimulatorTable<" + engines + "> table(description, Engine());\n";
    return text;
}

}  // namespace rddlc::cpp
