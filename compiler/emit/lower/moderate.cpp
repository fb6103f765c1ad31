#include "emit/lower/moderate.hpp"

#include "emit/lower/functions.hpp"
#include "emit/lower/tables.hpp"
#include "emit/templates.hpp"
#include "support/template_slots.hpp"

#include <cstddef>
#include <map>
#include <string>

namespace rddlc::cpp {

namespace {

bool steps_moderately(const Unit& unit) {
    const auto& moderate = unit.program.moderate;
    return moderate && (unit.has_packs() || !(*moderate)->only_in_packs);
}

// Both steps have the same records of the state.
void take_sliding_buffers(const Unit& around, Unit& unit) {
    std::map<std::string, std::string> sliding_buffers;
    for (std::size_t index = 0; index < around.program.buffers.size(); ++index)
        if (const std::string& sliding = around.names.sliding_buffers[index]; !sliding.empty())
            sliding_buffers[around.program.buffers[index].name] = sliding;
    for (std::size_t index = 0; index < unit.program.buffers.size(); ++index) {
        const ir::Buffer& buffer = unit.program.buffers[index];
        const auto sliding = sliding_buffers.find(buffer.name);
        if (sliding != sliding_buffers.end() &&
            is_one_of(buffer.storage, {ir::Storage::State, ir::Storage::Next}))
            unit.names.sliding_buffers[index] = sliding->second;
    }
}

}  // namespace

std::string moderate_section(const Unit& around) {
    if (!steps_moderately(around)) return "";
    Unit unit(**around.program.moderate, around.sources, around.options);
    unit.names.space = "moderate";
    take_sliding_buffers(around, unit);
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

std::string type_for_packs(const Unit& unit) {
    return steps_moderately(unit) ? "FastSimulator" : "Simulator";
}

std::string type_for_one(const Unit& unit) {
    const bool is_fast = steps_moderately(unit) && !(*unit.program.moderate)->only_in_packs;
    return is_fast ? "FastSimulator" : "Simulator";
}

}  // namespace rddlc::cpp
