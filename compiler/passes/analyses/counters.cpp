#include "passes/analyses/counters.hpp"

#include "ir/analysis.hpp"
#include "ir/nest.hpp"
#include "ir/rewrite.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>

namespace rddlc::passes {
namespace {

// The steps of an episode that are followed, and how far apart the values may lie.
constexpr std::int64_t most_steps = 1024;
constexpr double most_values = 2 * most_steps;

class CounterSearch {
  public:
    explicit CounterSearch(ir::Builder& builder) : builder_(builder) {}

    std::map<ir::BufferId, Range> find() {
        std::map<ir::BufferId, Range> found;
        const std::int64_t horizon = program().horizon;
        if (horizon == 0 || horizon > most_steps) return found;
        for (const ir::Definition& definition : program().step) {
            const auto* store = ir::only_statement<ir::Store>(definition.body);
            if (!store || !is_int(store->target, ir::Storage::Next)) continue;
            const auto now = state_of(store->target);
            if (!now || is_drawn(*now) || !depends_only_on(store->value, *now)) continue;
            if (const auto range = values_of(*now, store->value)) found[*now] = *range;
        }
        return found;
    }

  private:
    const ir::Program& program() const { return builder_.program(); }
    bool is_int(ir::BufferId id, ir::Storage storage) const {
        const ir::Buffer& buffer = program()[id];
        return buffer.storage == storage && buffer.scalar == ir::Scalar::Int &&
               buffer.shape.empty();
    }

    std::optional<ir::BufferId> state_of(ir::BufferId next) const {
        for (std::uint32_t index = 0; index < program().buffers.size(); ++index)
            if (is_int({index}, ir::Storage::State) &&
                program()[ir::BufferId{index}].name == program()[next].name)
                return ir::BufferId{index};
        return std::nullopt;
    }
    bool is_drawn(ir::BufferId state) const {
        return std::ranges::any_of(program().reset, [&](const ir::Definition& definition) {
            return definition.target == state;
        });
    }
    bool depends_only_on(ir::NodeId id, ir::BufferId state) const {
        if (std::holds_alternative<ir::Local>(program()[id].form)) return false;
        const auto buffer = ir::buffer_read_by(program()[id]);
        if (buffer && *buffer != state && program()[*buffer].storage != ir::Storage::Constant)
            return false;
        return std::ranges::all_of(ir::operands_of(program()[id]), [&](ir::NodeId operand) {
            return depends_only_on(operand, state);
        });
    }

    // Nothing if the next value is not a constant for each of them.
    std::optional<Range> values_of(ir::BufferId state, ir::NodeId next) {
        const ir::NodeId load = builder_.load(state, {});
        auto value = std::get<std::int64_t>(program()[state].values[0]);
        Range range{static_cast<double>(value), static_cast<double>(value)};
        for (std::int64_t step = 0; step < program().horizon; ++step) {
            std::map<ir::NodeId, ir::NodeId> known = {{load, builder_.constant(value)}};
            const ir::NodeId result = ir::replace_in(builder_, next, known);
            const auto* constant = std::get_if<ir::Constant>(&program()[result].form);
            if (!constant) return std::nullopt;
            value = std::get<std::int64_t>(constant->value);
            range = join(range, Range{static_cast<double>(value), static_cast<double>(value)});
            if (range.upper - range.lower > most_values || range.lower <= -exact_ints ||
                range.upper >= exact_ints)
                return std::nullopt;
        }
        return range;
    }

    ir::Builder& builder_;
};

}  // namespace

std::map<ir::BufferId, Range> find_counters(ir::Builder& builder) {
    return CounterSearch(builder).find();
}

}  // namespace rddlc::passes
