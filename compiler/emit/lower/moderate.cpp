#include "emit/lower/moderate.hpp"

#include "emit/lower/functions.hpp"
#include "emit/lower/tables.hpp"
#include "emit/templates.hpp"
#include "support/template_slots.hpp"

namespace rddlc::cpp {

std::string moderate_section(const Unit& around) {
    if (!around.program.moderate) return "";
    Unit unit(**around.program.moderate, around.sources, around.options);
    unit.names.space = "moderate";
    const StepFunctions step = step_functions(unit);
    const std::string text =
        fill_slots(templates::moderate, {{"tables", tables(unit, &around)},
                                         {"scratch", record(unit, "Scratch", ir::Storage::Scratch)},
                                         {"aliases", record_aliases(unit, {"Scratch"})},
                                         {"test", moderate_test(unit)},
                                         {"step", step.step},
                                         {"cpfs", step.cpfs},
                                         {"reward", reward_function(unit)}});
    return section("moderate values", text);
}

std::string stepping_type(const Unit& unit) {
    return unit.program.moderate ? "FastSimulator" : "Simulator";
}

}  // namespace rddlc::cpp
