#include "emit/emit.hpp"

#include "emit/cpp/line_directives.hpp"
#include "emit/cpp/literals.hpp"
#include "emit/lower/about.hpp"
#include "emit/lower/details.hpp"
#include "emit/lower/externals.hpp"
#include "emit/lower/functions.hpp"
#include "emit/lower/moderate.hpp"
#include "emit/lower/tables.hpp"
#include "emit/lower/unit.hpp"
#include "emit/names/identifiers.hpp"
#include "emit/templates.hpp"
#include "support/template_slots.hpp"

#include <algorithm>
#include <cctype>
#include <optional>

namespace rddlc {
namespace {

using cpp::DetailsUnit;
using cpp::Unit;

std::string about_file(const Unit& unit) {
    const ir::Program& program = unit.program;
    std::string text = "// A simulator, made by rddlc " + unit.options.compiler_version +
                       ". Do not edit it: change its sources and compile them again.\n//\n";
    text += "//     problem   " + cpp::comment_text(program.domain_name) + "\n";
    text += "//     instance  " + cpp::comment_text(program.instance_name) + "\n";
    for (FileId file = 0; file < unit.sources.size(); ++file) {
        text += file == 0 ? "//     sources   " : "//               ";
        text += cpp::comment_text(unit.sources[file].path()) + "\n";
    }
    return text;
}

// Sections that turned out empty leave runs of blank lines.
std::string without_double_blanks(const std::string& text) {
    std::string result;
    for (char c : text) {
        const bool third = c == '\n' && result.ends_with("\n\n");
        if (!third) result += c;
    }
    return result;
}

std::string engine(const Unit& unit) {
    const std::string start = "rddl::Compiled<" + cpp::type_for_one(unit) + ", about::problem";
    if (unit.program.policy) return start + ", rddl::Scalar, Policy>";
    if (unit.program.real == RealType::Float) return start + ", rddl::ScalarOf<float>>";
    return start + ">";
}

std::string action_bools(const Unit& unit) {
    if (!unit.tests_action_bools) return "";
    return "    // The bytes of the action's bools are tested where they are read.\n"
           "    static constexpr bool tests_action_bools = true;\n";
}

std::string simulator(const Unit& unit, const DetailsUnit* details) {
    const cpp::StepFunctions step = cpp::step_functions(unit);
    return fill_slots(cpp::templates::simulator,
                      {{"objects", cpp::objects(unit)},
                       {"externals", cpp::external_asserts(unit)},
                       {"tables", cpp::tables(unit)},
                       {"records", cpp::records(unit)},
                       {"aliases", cpp::record_aliases(unit)},
                       {"partially_observed", unit.program.partially_observed() ? "true" : "false"},
                       {"action_bools", action_bools(unit)},
                       {"sliding_buffers", cpp::sliding_buffer_functions(unit)},
                       {"reset", cpp::reset_function(unit)},
                       {"step", step.step},
                       {"reward", cpp::reward_function(unit)},
                       {"conditions", cpp::condition_functions(unit)},
                       {"cpfs", step.cpfs},
                       {"policy", cpp::policy(unit)},
                       {"moderate", cpp::moderate_section(unit)},
                       {"details", details ? cpp::details_section(*details, unit) : ""},
                       {"asserts", cpp::asserts(unit)},
                       {"about", cpp::about(unit, details)},
                       {"engine", engine(unit)},
                       {"table", cpp::table_definition(unit, details != nullptr)}});
}

std::string entry_of(const ir::Program& program, const EmitOptions& options) {
    return options.entry.empty() ? cpp::names_of(program).entry : options.entry;
}

std::string file(const Unit& unit, const DetailsUnit* details) {
    SlotValues values = {
        {"about_file", about_file(unit)},
        {"externals", cpp::external_includes(unit.program, unit.options.extern_headers)},
        {"space", unit.names.space},
        {"simulator", simulator(unit, details)}};
    if (unit.options.header) return fill_slots(cpp::templates::header, values);
    values.emplace("entry", entry_of(unit.program, unit.options));
    return fill_slots(cpp::templates::source, values);
}

}  // namespace

std::string emit(const ir::Program& program, const Sources& sources, const EmitOptions& options,
                 const ir::Details* details) {
    const Unit unit(program, sources, options);
    std::optional<DetailsUnit> details_unit;
    if (details) details_unit.emplace(*details, sources, options);
    const std::string text = file(unit, details_unit ? &*details_unit : nullptr);
    const std::string whole = without_double_blanks(text);
    return options.line_directives ? cpp::restore_lines(whole, options.output_name) : whole;
}

std::string emit_declaration(const ir::Program& program, const EmitOptions& options) {
    const std::string entry = entry_of(program, options);
    std::string guard = entry + "_h";
    for (char& c : guard) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return fill_slots(cpp::templates::declaration,
                      {{"version", options.compiler_version},
                       {"problem", cpp::comment_text(program.domain_name)},
                       {"instance", cpp::comment_text(program.instance_name)},
                       {"guard", guard},
                       {"entry", entry}});
}

bool can_be_entry(std::string_view name) {
    const auto is_letter = [](unsigned char c) {
        return c == '_' || (c < 0x80 && std::isalpha(c));
    };
    const auto fits = [&](unsigned char c) {
        return is_letter(c) || (c < 0x80 && std::isdigit(c));
    };
    return !name.empty() && is_letter(static_cast<unsigned char>(name.front())) &&
           std::ranges::all_of(name, fits) && name.find("__") == name.npos &&
           !cpp::is_keyword(name) && name != "main";
}

}  // namespace rddlc
