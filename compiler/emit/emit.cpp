#include "emit/emit.hpp"

#include "emit/about.hpp"
#include "emit/externals.hpp"
#include "emit/functions.hpp"
#include "emit/line_directives.hpp"
#include "emit/literals.hpp"
#include "emit/tables.hpp"
#include "emit/templates.hpp"
#include "emit/unit.hpp"
#include "support/template_slots.hpp"

namespace rddlc {
namespace {

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
    if (unit.program.policy)
        return "rddl::Compiled<Simulator, about::problem, rddl::Scalar, Policy>";
    if (unit.program.real == RealType::Float)
        return "rddl::Compiled<Simulator, about::problem, rddl::ScalarOf<float>>";
    return "rddl::Compiled<Simulator, about::problem>";
}

std::string simulator(const Unit& unit) {
    const cpp::StepFunctions step = cpp::step_functions(unit);
    return fill_slots(cpp::templates::simulator,
                      {{"objects", cpp::objects(unit)},
                       {"externals", cpp::external_asserts(unit)},
                       {"tables", cpp::tables(unit)},
                       {"records", cpp::records(unit)},
                       {"aliases", cpp::record_aliases(unit)},
                       {"partially_observed", unit.program.partially_observed() ? "true" : "false"},
                       {"reset", cpp::reset_function(unit)},
                       {"step", step.step},
                       {"reward", cpp::reward_function(unit)},
                       {"conditions", cpp::condition_functions(unit)},
                       {"cpfs", step.cpfs},
                       {"policy", cpp::policy(unit)},
                       {"asserts", cpp::asserts(unit)},
                       {"about", cpp::about(unit)},
                       {"engine", engine(unit)},
                       {"table", cpp::table_definition(unit)}});
}

std::string file(const Unit& unit) {
    SlotValues values = {
        {"about_file", about_file(unit)},
        {"externals", cpp::external_includes(unit.program, unit.options.extern_headers)},
        {"space", unit.names.space},
        {"simulator", simulator(unit)}};
    if (unit.options.header) return fill_slots(cpp::templates::header, values);
    values.emplace("entry", unit.names.entry);
    return fill_slots(cpp::templates::source, values);
}

}  // namespace

std::string emit(const ir::Program& program, const Sources& sources, const EmitOptions& options) {
    const Unit unit(program, sources, options);
    return cpp::restore_lines(without_double_blanks(file(unit)), options.output_name);
}

}  // namespace rddlc
