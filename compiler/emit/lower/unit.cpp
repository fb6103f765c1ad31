#include "emit/lower/unit.hpp"

#include "emit/cpp/literals.hpp"
#include "ir/action_bools.hpp"
#include "ir/lane_count.hpp"
#include "ir/narrow_bits.hpp"
#include "ir/shifted_row.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <variant>

namespace rddlc::cpp {

namespace {

// Sites whose numbers lie in one register (sites_at_once in rddl/random/random.hpp), with AVX-512.
constexpr std::uint32_t sites_of_register = 8;
// A processor makes the numbers of so many sites side by side without one.
constexpr std::ptrdiff_t most_alone = 3;

// If its operands are.
bool keeps_uniform(const ir::Program& program, const ir::Node& node) {
    if (node.type != ir::Scalar::Int) return false;
    return match(
        node.form, [](const ir::Index&) { return true; }, [](const ir::Constant&) { return true; },
        [&](const ir::Load& load) { return program[load.buffer].storage == ir::Storage::Constant; },
        [](const ir::Apply& apply) { return !apply.place; }, [](const auto&) { return false; });
}

}  // namespace

Unit::Unit(const ir::Program& the_program, const Sources& the_sources,
           const EmitOptions& the_options)
    : program(the_program),
      sources(the_sources),
      options(the_options),
      names(names_of(the_program)),
      properties(ir::all_properties(the_program)),
      uniform_ints(the_program.nodes.size(), false),
      contains_branch(the_program.nodes.size(), false),
      tests_action_bools(ir::tests_action_bools(the_program)),
      narrow_bits(has_packs() && !has_byte_ints()
                      ? ir::narrow_bits(the_program, properties)
                      : std::vector<bool>(the_program.nodes.size(), false)),
      left_out(ir::read_by_shifts_alone(the_program)),
      lone_series_(series_of_lone_draws()),
      chosen_series_(series_chosen_by_tables()) {
    for (std::size_t index = 0; index < program.nodes.size(); ++index) {
        const ir::Node& node = program.nodes[index];
        const std::vector<ir::NodeId> operands = ir::operands_of(node);
        uniform_ints[index] =
            keeps_uniform(program, node) &&
            std::ranges::all_of(operands, [&](ir::NodeId operand) { return is_uniform(operand); });
        const auto* select = std::get_if<ir::Select>(&node.form);
        contains_branch[index] = select && select->evaluated != ir::Evaluated::Both;
        for (ir::NodeId operand : operands) {
            if (contains_branch[operand.index]) contains_branch[index] = true;
        }
    }
    step_draws = StepDraws(program, [&](const ir::Place& place) { return !is_among_sites(place); });
    step_normals = StepNormals(program, properties);
}

std::set<std::uint32_t> Unit::series_of_lone_draws() const {
    std::set<std::uint32_t> all;
    const auto add = [&](const ir::Place& place) {
        if (is_lone(place)) all.insert(program.series_of(place.site).index);
    };
    for (const ir::Node& node : program.nodes)
        match(
            node.form,
            [&](const ir::Sample& sample) {
                if (is_by_inversion(sample.distribution)) add(sample.place);
            },
            [&](const ir::Interval& interval) { add(interval.place); },
            [&](const ir::Discrete& discrete) { add(discrete.place); },
            [&](const ir::DiscreteOver& discrete) { add(discrete.place); }, [](const auto&) {});
    return all;
}

// Operands stand before the nodes that use them.
std::set<std::uint32_t> Unit::series_chosen_by_tables() const {
    std::vector<bool> is_chosen(program.nodes.size(), false);
    std::set<std::uint32_t> all;
    for (std::size_t index = program.nodes.size(); index-- > 0;) {
        const ir::Node& node = program.nodes[index];
        const auto* const select = std::get_if<ir::Select>(&node.form);
        if (select && select->evaluated != ir::Evaluated::Both &&
            properties_of(select->condition).uniform)
            is_chosen[select->then_value.index] = is_chosen[select->else_value.index] = true;
        if (!is_chosen[index]) continue;
        for (const ir::NodeId operand : ir::operands_of(node)) is_chosen[operand.index] = true;
        if (const auto* const sample = std::get_if<ir::Sample>(&node.form))
            all.insert(program.series_of(sample->place.site).index);
    }
    return all;
}

bool Unit::is_chosen_by_table(const ir::Place& place) const {
    return chosen_series_.contains(program.series_of(place.site).index);
}

bool Unit::is_lone(const ir::Place& place) const {
    return std::holds_alternative<ir::Constant>(program[place.index].form);
}

bool Unit::is_among_sites(const ir::Place& place) const {
    const std::uint32_t series = program.series_of(place.site).index;
    const std::uint32_t first = series / sites_of_register * sites_of_register;
    return std::distance(lone_series_.lower_bound(first),
                         lone_series_.lower_bound(first + sites_of_register)) > most_alone;
}

std::vector<ir::NodeId> Unit::operands_of(const ir::Node& node) const {
    std::vector<ir::NodeId> operands = ir::operands_of(node);
    const auto* apply = std::get_if<ir::Apply>(&node.form);
    if (!apply || apply->op != Operator::Multiply || node.type != ir::Scalar::Int) return operands;
    for (ir::NodeId& operand : operands) {
        const auto factor = ir::converted_bool(program, operand);
        if (!factor || properties_of(operand).uniform) continue;
        operand = *factor;
        break;
    }
    return operands;
}

bool Unit::has_packs() const {
    return options.lane_count > 1 && ir::why_without_packs(program).empty();
}

std::string Unit::size_of(const ir::Variable& variable) const {
    return variable.type ? count_of(*variable.type, variable.size) : std::to_string(variable.size);
}

std::string Unit::count_of(std::uint32_t type, std::int64_t size) const {
    const auto all = static_cast<std::int64_t>(program.types[type].objects.size());
    return size == all ? names.counts[type] : std::to_string(size);
}

std::string Unit::where(Span span) const {
    const std::string file = std::filesystem::path(sources[span.file].path()).filename().string();
    return comment_text(file) + ":" + std::to_string(sources.position(span).line);
}

}  // namespace rddlc::cpp
