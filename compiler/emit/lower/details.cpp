#include "emit/lower/details.hpp"

#include "emit/lower/functions.hpp"
#include "emit/lower/tables.hpp"
#include "emit/templates.hpp"
#include "support/template_slots.hpp"

namespace rddlc::cpp {

DetailsUnit::DetailsUnit(const ir::Details& of_problem, const Sources& sources,
                         const EmitOptions& options)
    : details(of_problem), unit(details.program, sources, options) {
    unit.names.space = "details";
}

std::string details_section(const DetailsUnit& details, const Unit& around) {
    const Unit& unit = details.unit;
    const StepFunctions step = step_functions(unit);
    const std::string text = fill_slots(
        templates::details, {{"tables", tables(unit, &around)},
                             {"scratch", record(unit, "Scratch", ir::Storage::Scratch)},
                             {"record", record(unit, "Observation", ir::Storage::Observation)},
                             {"aliases", record_aliases(unit, {"Scratch", "Observation"})},
                             {"step", step.step},
                             {"cpfs", step.cpfs}});
    return section("details", text);
}

}  // namespace rddlc::cpp
