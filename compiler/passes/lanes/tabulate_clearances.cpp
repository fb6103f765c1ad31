#include "passes/lanes/tabulate_clearances.hpp"

#include "ir/builder.hpp"
#include "ir/nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/object_condition.hpp"
#include "passes/analyses/refutation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// A jump that is predicted wrongly takes as long as half of so many operations.
constexpr double worth_a_look = 64;
// Objects in a register of reals.
constexpr std::int64_t at_once = 8;
// A byte for each cell: the table fits into the first-level cache beside all else.
constexpr std::int64_t cells_of_line = 1024, cells_of_side = 64;
constexpr std::size_t most_places = 2, most_moves = 2;
// Objects that are far from a block of so many cells in each dimension are left out at once.
constexpr std::int64_t block_side = 8;
// Clearances are multiples of a part of a cell's width. Few of them are tried.
constexpr double units_per_cell = 16;
constexpr std::int64_t levels[] = {0, 1, 2, 4, 6, 8, 11, 14, 18, 23, 29, 36, 45};
constexpr std::size_t highest_level = std::size(levels) - 1;
// A move nearer to 0 has no clearance, so that the proof may neglect how its sum with a place is
// rounded.
constexpr double least_move_in_units = 0x1p-6;
// The edges of cells are rounded when a step looks for its cell.
constexpr double edge = 0x1p-21;
// A table pays if so many of its cells have a clearance of a quarter of a cell.
constexpr double least_share = 0.5;
constexpr std::int64_t worth_units = 4;

struct Axis {
    std::size_t number;
    double begin, width;  // of a cell
};

// The places and moves of a condition.
struct Split {
    std::vector<Axis> axes;
    std::vector<std::size_t> moves;
    std::int64_t cells;  // in each dimension
    double unit;
};

std::optional<Split> split(const ObjectCondition& condition) {
    Split result{};
    std::vector<std::pair<double, double>> ends;
    for (std::size_t k = 0; k < condition.numbers.size(); ++k) {
        const auto constants = condition.constants_near(k);
        if (!constants) {
            result.moves.push_back(k);
            continue;
        }
        result.axes.push_back({k, constants->first, 0});
        ends.push_back(*constants);
    }
    if (result.axes.empty() || result.axes.size() > most_places || result.moves.size() > most_moves)
        return std::nullopt;
    result.cells = result.axes.size() == 1 ? cells_of_line : cells_of_side;
    for (std::size_t k = 0; k < ends.size(); ++k) {
        const double width = (ends[k].second - ends[k].first) / static_cast<double>(result.cells);
        if (!(width > 0) || !std::isfinite(width)) return std::nullopt;
        result.axes[k].width = width;
        result.unit = std::max(result.unit, width / units_per_cell);
    }
    result.unit = static_cast<float>(result.unit);
    return result;
}

// The clearances of all cells, in units.
class Clearing {
  public:
    Clearing(const ObjectCondition& condition, const Split& split, std::int64_t objects)
        : condition_(condition),
          split_(split),
          count_(objects),
          clear_at_(static_cast<std::size_t>(objects)),
          bounds_(condition.numbers.size()) {}

    std::vector<std::int64_t> run() {
        std::vector<std::int64_t> units(static_cast<std::size_t>(count_of(split_.cells)));
        const std::int64_t blocks = split_.cells / block_side,
                           cells_of_block = count_of(block_side);
        for (std::int64_t block = 0; block < count_of(blocks); ++block) {
            const Place begin = place_of(block, blocks, block_side);
            look_at(begin, block_side);
            find_objects();
            for (std::int64_t k = 0; k < cells_of_block; ++k) {
                Place cell = place_of(k, block_side, 1);
                std::int64_t index = 0;
                for (std::size_t d = 0; d < cell.size(); ++d) {
                    cell[d] += begin[d];
                    index = index * split_.cells + cell[d];
                }
                look_at(cell, 1);
                units[static_cast<std::size_t>(index)] = clearance();
            }
        }
        return units;
    }

  private:
    using Place = std::vector<std::int64_t>;  // of a cell, in each dimension

    std::int64_t count_of(std::int64_t side) const {
        return split_.axes.size() == 1 ? side : side * side;
    }
    // The place of one of side * ... * side squares, each so many cells wide, in row-major order.
    Place place_of(std::int64_t index, std::int64_t side, std::int64_t width) const {
        Place place(split_.axes.size());
        for (std::size_t k = place.size(); k-- > 0; index /= side) place[k] = index % side * width;
        return place;
    }

    // Bounds the places by a square of cells.
    void look_at(const Place& begin, std::int64_t side) {
        for (std::size_t k = 0; k < begin.size(); ++k) {
            const Axis& axis = split_.axes[k];
            const double margin =
                edge * (static_cast<double>(split_.cells) * axis.width + std::fabs(axis.begin));
            const auto cell = static_cast<double>(begin[k]);
            bounds_[axis.number] =
                between(axis.begin + cell * axis.width - margin,
                        axis.begin + (cell + static_cast<double>(side)) * axis.width + margin);
        }
    }

    void bound_moves(double greatest) {
        for (const std::size_t move : split_.moves) bounds_[move] = between(-greatest, greatest);
    }

    // Leaves out objects that matter nowhere in the square.
    void find_objects() {
        bound_moves(split_.unit * static_cast<double>(levels[highest_level]));
        objects_.clear();
        for (std::int64_t object = 0; object < count_; ++object)
            if (!is_false_within(condition_, object, bounds_)) objects_.push_back(object);
    }

    // Neighbours have similar clearances, and the same objects near them.
    std::int64_t clearance() {
        std::ranges::fill(clear_at_, 0);
        if (split_.moves.empty()) return find_object_at(1) ? 0 : 1;
        const std::size_t before = level_;
        while (level_ > 0 && find_object_at(levels[level_])) --level_;
        if (level_ == before)
            while (level_ < highest_level && !find_object_at(levels[level_ + 1])) ++level_;
        return levels[level_];
    }

    // Whether an object may matter. It is the first one to be tried next.
    bool find_object_at(std::int64_t units) {
        const auto found = std::ranges::find_if(
            objects_, [&](std::int64_t object) { return !is_clear(object, units); });
        if (found == objects_.end()) return false;
        std::rotate(objects_.begin(), found, found + 1);
        return true;
    }

    bool is_clear(std::int64_t object, std::int64_t units) {
        std::int64_t& known = clear_at_[static_cast<std::size_t>(object)];
        if (units <= known) return true;
        const double greatest = static_cast<double>(units) * split_.unit;
        bound_moves(greatest);
        const bool is_clear = is_false_within(condition_, object, bounds_) ||
                              std::ranges::any_of(split_.moves, [&](std::size_t move) {
                                  return is_clear_by_size_of(move, object, greatest);
                              });
        if (is_clear) known = units;
        return is_clear;
    }

    // With the size of a move as the parameter of all bounds.
    bool is_clear_by_size_of(std::size_t move, std::int64_t object, double greatest) {
        const LineBounds before = bounds_[move];
        const Line size = {least_move_in_units * split_.unit, greatest};
        bounds_[move] = {size, size};
        const bool to_the_right = is_refuted_within(condition_, object, bounds_);
        bounds_[move] = negate({size, size});
        const bool is_clear = to_the_right && is_refuted_within(condition_, object, bounds_);
        bounds_[move] = before;
        return is_clear;
    }

    const ObjectCondition& condition_;
    const Split& split_;
    std::int64_t count_;                  // of objects
    std::vector<std::int64_t> objects_;   // near the block, those that matter most often first
    std::vector<std::int64_t> clear_at_;  // by object: units that are known for the cell
    std::vector<LineBounds> bounds_;      // of the numbers
    std::size_t level_ = 0;               // of the last cell
};

class Tabulation {
  public:
    Tabulation(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        ir::for_each_loop(program_, [&](ir::Loop& loop, Span span) { change(loop, span); });
        return std::move(program_);
    }

  private:
    void change(ir::Loop& loop, Span span) {
        const std::int64_t objects = program_[loop.variable].size;
        const auto* found = quantifying_store(loop);
        if (loop.clearances || !found || objects < at_once ||
            cost_of(loop) * static_cast<double>((objects + at_once - 1) / at_once) < worth_a_look)
            return;
        const auto& either = std::get<ir::Apply>(program_[found->value].form);
        if (either.op != Operator::Or) return;
        const auto condition =
            object_condition(program_, std::span(loop.body).first(loop.body.size() - 1),
                             either.operands.back(), loop.variable);
        const auto parts = condition ? split(*condition) : std::nullopt;
        if (!parts) return;
        const auto units = Clearing(*condition, *parts, objects).run();
        const auto worth = std::ranges::count_if(units, [&](std::int64_t each) {
            return each >= (parts->moves.empty() ? 1 : worth_units);
        });
        if (static_cast<double>(worth) < least_share * static_cast<double>(units.size())) return;
        loop.clearances = clearances(*condition, *parts, units, span);
        ++report_["loops over the objects near a place"];
    }

    // The cost for the objects in a register.
    double cost_of(const ir::Loop& loop) {
        double cost = 0;
        for (const ir::Statement& statement : loop.body)
            for (const ir::NodeId root : ir::roots_of(statement))
                cost += builder_.properties(root).cost;
        return cost;
    }

    // The store of a loop that quantifies (quantify_together); null if it fills a table.
    static const ir::Store* quantifying_store(const ir::Loop& loop) {
        if (!loop.several_at_once || loop.body.empty()) return nullptr;
        const auto* store = std::get_if<ir::Store>(&loop.body.back().form);
        const bool names_before = std::all_of(
            loop.body.begin(), loop.body.end() - 1,
            [](const ir::Statement& each) { return std::holds_alternative<ir::Let>(each.form); });
        return store && store->indices.empty() && names_before ? store : nullptr;
    }

    ir::Clearances clearances(const ObjectCondition& condition, const Split& parts,
                              const std::vector<std::int64_t>& units, Span span) {
        ir::Buffer table{.name = "clearances",
                         .storage = ir::Storage::Constant,
                         .scalar = ir::Scalar::Int,
                         .shape = std::vector(parts.axes.size(), parts.cells),
                         .span = span,
                         .holds_places = true};
        std::vector<ir::Value> values(units.begin(), units.end());
        table.values = std::move(values);
        ir::Clearances result{.table = builder_.tables().constant(std::move(table)),
                              .unit = parts.unit,
                              .least_move = least_move_in_units * parts.unit};
        for (const Axis& axis : parts.axes) {
            result.places.push_back(condition.numbers[axis.number]);
            result.begin.push_back(axis.begin);
            result.cells_per_unit.push_back(1 / axis.width);
        }
        for (const std::size_t move : parts.moves) result.moves.push_back(condition.numbers[move]);
        std::ranges::sort(result.moves);
        return result;
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
};

}  // namespace

ir::Program tabulate_clearances(ir::Program program, Report& report) {
    return Tabulation(std::move(program), report).run();
}

}  // namespace rddlc::passes
