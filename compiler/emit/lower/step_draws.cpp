#include "emit/lower/step_draws.hpp"

#include "ir/analysis.hpp"
#include "ir/nest.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <set>
#include <variant>

namespace rddlc::cpp {
namespace {

// The numbers of a row: two for each of its counters.
constexpr std::size_t counters_of_row = 4;
constexpr std::int64_t objects_of_row = 2 * counters_of_row;
// A single row would be made where it is used as well, unless objects are visited one by one.
constexpr std::size_t least_rows = 2;

// Calls take(place) for the draws by one number that an evaluation certainly makes.
template <class Take>
class CertainDraws {
  public:
    // Several objects at once evaluate both operands of a connective.
    CertainDraws(const ir::Program& program, bool over_several, Take take)
        : program_(program), over_several_(over_several), take_(std::move(take)) {}

    void in(ir::NodeId id) {
        if (!seen_.insert(id).second) return;
        const ir::Node& node = program_[id];
        match(
            node.form,
            [&](const ir::Select& select) {
                in(select.condition);
                if (select.evaluated != ir::Evaluated::Both)
                    return in_both(select.then_value, select.else_value);
                in(select.then_value);
                in(select.else_value);
            },
            [&](const ir::Apply& apply) {
                const bool may_stop = node.type == ir::Scalar::Bool && !over_several_ &&
                                      is_one_of(apply.op, {Operator::And, Operator::Or});
                if (may_stop) return in(apply.operands.front());
                for (const ir::NodeId operand : apply.operands) in(operand);
            },
            [&](const ir::Reduce&) {},
            [&](const ir::Sample& sample) {
                if (sample.distribution == Distribution::Bernoulli &&
                    !has_chances(sample.parameters.front()))
                    take_(sample.place);
                for (const ir::NodeId parameter : sample.parameters) in(parameter);
            },
            [&](const ir::Discrete& discrete) { take_(discrete.place); },
            [&](const ir::DiscreteOver& discrete) { take_(discrete.place); },
            [&](const ir::Interval& interval) { take_(interval.place); },
            [&](const auto&) {
                for (const ir::NodeId operand : ir::operands_of(node)) in(operand);
            });
    }

  private:
    // Only one of them is evaluated.
    void in_both(ir::NodeId a, ir::NodeId b) {
        const std::vector<ir::Place> of_a = draws_of(a), of_b = draws_of(b);
        for (const ir::Place& place : of_a)
            if (std::ranges::find(of_b, place) != of_b.end()) take_(place);
    }
    std::vector<ir::Place> draws_of(ir::NodeId id) const {
        std::vector<ir::Place> places;
        CertainDraws<std::function<void(const ir::Place&)>> draws(
            program_, over_several_, [&](const ir::Place& place) { places.push_back(place); });
        draws.in(id);
        return places;
    }

    // Chances look for themselves which objects need numbers.
    bool has_chances(ir::NodeId id) const {
        const auto* const select = std::get_if<ir::Select>(&program_[id].form);
        const auto* const load =
            std::get_if<ir::Load>(&program_[select ? select->then_value : id].form);
        return load && load->gather == ir::Gather::Chances;
    }

    const ir::Program& program_;
    bool over_several_;
    Take take_;
    std::set<ir::NodeId> seen_;
};

// Packs draw for each object, and of some numbers of objects they know a better way.
bool fills_row(const ir::Program& program, const ir::Loop& loop) {
    const std::int64_t objects = ir::combinations(program, ir::nest_of(loop).variables);
    return (loop.several_at_once || (objects > 1 && !leaves_few_numbers(objects))) &&
           objects <= objects_of_row && ir::takes_all_objects(loop);
}

}  // namespace

bool leaves_few_numbers(std::int64_t objects) {
    constexpr std::int64_t at_once = 4, many = 8;
    return objects < many && (objects % at_once == 1 || objects % at_once == 2);
}

StepDraws::StepDraws(const ir::Program& program,
                     const std::function<bool(const ir::Place&)>& takes_lane) {
    std::vector<Row> lone_rows;
    std::vector<std::pair<ir::Place, Where>> lone;
    const auto series_of = [&](const ir::Place& place) {
        return program.series_of(place.site).index;
    };
    const auto add_lone = [&](const ir::Place& place) {
        const auto* const index = std::get_if<ir::Constant>(&program[place.index].form);
        if (!index || !takes_lane(place)) return;
        if (lone_rows.empty() || lone_rows.back().lone.size() == counters_of_row)
            lone_rows.emplace_back();
        auto& lanes = lone_rows.back().lone;
        lone.push_back({place, {.row = lone_rows.size() - 1, .lane = lanes.size()}});
        lanes.push_back({series_of(place), std::get<std::int64_t>(index->value)});
    };
    bool has_one_by_one = false;
    const auto add_loop = [&](const ir::Loop& loop, const ir::Nest& nest, const ir::Place& place) {
        if (!ir::is_place_in(program, nest, place.index) || found_.contains(place)) return;
        found_[place] = {.row = rows_.size(), .over_several = loop.several_at_once};
        has_one_by_one = has_one_by_one || !loop.several_at_once;
        rows_.push_back({.loop = series_of(place)});
    };
    for (const ir::Definition& definition : program.step) {
        if (definition.unchosen) continue;
        CertainDraws outside(program, false, add_lone);
        for (const ir::Statement& statement : definition.body) {
            if (const auto* let = std::get_if<ir::Let>(&statement.form)) outside.in(let->value);
            if (const auto* store = std::get_if<ir::Store>(&statement.form))
                outside.in(store->value);
            const auto* const loop = std::get_if<ir::Loop>(&statement.form);
            if (!loop || !fills_row(program, *loop)) continue;
            const ir::Nest nest = ir::nest_of(*loop);
            CertainDraws inside(program, loop->several_at_once,
                                [&](const ir::Place& place) { add_loop(*loop, nest, place); });
            for (const ir::NodeId value : ir::values_of(*nest.body)) inside.in(value);
        }
    }
    for (auto& [place, where] : lone)
        found_[place] = {.row = where.row + rows_.size(), .lane = where.lane};
    std::ranges::move(lone_rows, std::back_inserter(rows_));
    if (rows_.size() >= least_rows || has_one_by_one) return;
    rows_.clear();
    found_.clear();
}

std::optional<StepDraws::Where> StepDraws::find(const ir::Place& place) const {
    const auto found = found_.find(place);
    return found == found_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace rddlc::cpp
