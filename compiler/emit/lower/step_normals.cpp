#include "emit/lower/step_normals.hpp"

#include "ir/nest.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <set>
#include <variant>

namespace rddlc::cpp {
namespace {

// One environment computes so many objects at once (rddl/object_lanes/objects.hpp).
constexpr std::int64_t objects_of_register = 16;
// The normals of a step stay in the nearest cache.
constexpr std::int64_t most_normals = 512;
// The normals of a single loop share registers without being made before.
constexpr std::size_t least_loops = 2;

// Calls take(place) for the normals that every register of a loop's objects makes.
template <class Take>
class CertainNormals {
  public:
    CertainNormals(const ir::Program& program, const std::vector<ir::Properties>& properties,
                   const ir::Nest& nest, Take take)
        : program_(program), properties_(properties), nest_(nest), take_(std::move(take)) {}

    void in(ir::NodeId id) {
        if (!seen_.insert(id).second) return;
        const ir::Node& node = program_[id];
        match(
            node.form,
            [&](const ir::Select& select) {
                const bool both = select.evaluated == ir::Evaluated::Both;
                in(select.condition);
                if (both || is_in_all_registers(select.condition, true)) in(select.then_value);
                if (both || is_in_all_registers(select.condition, false)) in(select.else_value);
            },
            [&](const ir::Reduce&) {},
            [&](const ir::Sample& sample) {
                if (sample.distribution == Distribution::Normal &&
                    ir::is_place_in(program_, nest_, sample.place.index))
                    take_(sample.place);
                for (const ir::NodeId parameter : sample.parameters) in(parameter);
            },
            [&](const auto&) {
                for (const ir::NodeId operand : ir::operands_of(node)) in(operand);
            });
    }

  private:
    // Whether each register has objects for which the condition, of constant tables, is `chosen`.
    // If all objects share a register, it has: a condition that is the same for all is folded.
    bool is_in_all_registers(ir::NodeId condition, bool chosen) const {
        if (!properties_[condition.index].uniform) return false;
        const std::int64_t count = ir::combinations(program_, nest_.variables);
        if (count <= objects_of_register) return true;
        const auto* const load = std::get_if<ir::Load>(&program_[condition].form);
        if (!load || program_[load->buffer].storage != ir::Storage::Constant ||
            program_[load->buffer].count() != count ||
            !ir::begins_with(program_, load->indices, nest_))
            return false;
        const std::vector<Value> values = program_[load->buffer].values.dense();
        for (auto first = values.begin(); first != values.end();) {
            const auto end =
                first + std::min<std::ptrdiff_t>(objects_of_register, values.end() - first);
            if (std::find(first, end, Value(chosen)) == end) return false;
            first = end;
        }
        return true;
    }

    const ir::Program& program_;
    const std::vector<ir::Properties>& properties_;
    const ir::Nest& nest_;
    Take take_;
    std::set<ir::NodeId> seen_;
};

}  // namespace

StepNormals::StepNormals(const ir::Program& program,
                         const std::vector<ir::Properties>& properties) {
    if (program.real != RealType::Double) return;
    std::map<std::uint32_t, std::size_t> by_series;
    std::int64_t normals = 0;
    const auto add = [&](const ir::Nest& nest, const ir::Place& place) {
        const std::uint32_t series = program.series_of(place.site).index;
        const std::int64_t count = ir::combinations(program, nest.variables);
        if (!by_series.contains(series)) {
            if (normals + count > most_normals) return;
            normals += count;
            by_series[series] = loops_.size();
            loops_.push_back({series, nest.variables});
        }
        found_[place] = by_series[series];
    };
    for (const ir::Definition& definition : program.step) {
        if (definition.unchosen) continue;
        for (const ir::Statement& statement : definition.body) {
            const auto* const loop = std::get_if<ir::Loop>(&statement.form);
            if (!loop || !loop->several_at_once || !ir::takes_all_objects(*loop)) continue;
            const ir::Nest nest = ir::nest_of(*loop);
            CertainNormals inside(program, properties, nest,
                                  [&](const ir::Place& place) { add(nest, place); });
            for (const ir::NodeId value : ir::values_of(*nest.body)) inside.in(value);
        }
    }
    if (loops_.size() >= least_loops) return;
    loops_.clear();
    found_.clear();
}

std::optional<std::size_t> StepNormals::find(const ir::Place& place) const {
    const auto found = found_.find(place);
    return found == found_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace rddlc::cpp
