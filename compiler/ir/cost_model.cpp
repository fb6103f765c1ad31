#include "ir/cost_model.hpp"

#include "ir/analysis.hpp"
#include "ir/shares.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace rddlc::ir {
namespace {

// One bit or two are 1.
constexpr double union_cost = 4;
// Sines and cosines of a register.
constexpr double angles_at_once = 8, cost_of_angles = 2 * elementary_cost;
// Packs turn the bits of lanes into masks.
constexpr double spread_cost = 8;

double size_of(const Program& program, VariableId variable) {
    return static_cast<double>(program[variable].size);
}

bool is_draw(const Node& node) {
    return match(
        node.form, [](const Sample&) { return true; }, [](const Discrete&) { return true; },
        [](const DiscreteOver&) { return true; }, [](const Interval&) { return true; },
        [](const auto&) { return false; });
}

// Whether the objects are those behind another one, whose index plus a constant is the first.
bool is_behind_index(const Program& program, const Bounds& bounds) {
    const auto* begin = std::get_if<Apply>(&program[bounds.begin].form);
    return begin && begin->op == Operator::Add &&
           std::holds_alternative<Index>(program[begin->operands.front()].form);
}

// The average length: of the objects behind another one, or of the rows, where the bounds are
// neighbours in a table of where rows begin.
double length_of(const Program& program, const Bounds& bounds, double size) {
    if (is_behind_index(program, bounds)) return (size - 1) / 2;
    const auto* end = std::get_if<Load>(&program[bounds.end].form);
    const std::int64_t rows = end ? program[end->buffer].count() - 1 : 1;
    return size / static_cast<double>(std::max<std::int64_t>(rows, 1));
}

// The cost of a definition or computation whose nodes are each computed once, in the outermost loop
// where that is possible.
class BlockCost {
  public:
    // The cost is that of packs, which take one object after the other, if properties are given.
    BlockCost(const Program& program, std::span<const Properties> properties)
        : program_(program), properties_(properties) {}
    void add_body(const Block& body) {
        collect_stores(body, outside);
        add(body, outside);
    }
    void add_value(NodeId id) { add(id, outside); }
    const PackCost& total() const { return total_; }

  private:
    // A loop or a reduction around what is evaluated. Its level is the number of those around it.
    struct Around {
        std::size_t outer;
        VariableId variable;
        std::size_t level;
        double evaluations;  // of its body
    };
    using Place = std::size_t;  // index into arounds_
    static constexpr Place outside = 0;
    // The levels of the loops that a value depends on, as bits.
    using Levels = std::uint64_t;

    // A table that is filled in loops changes for what reads it inside of them.
    void collect_stores(const Block& block, Place place) {
        for (const Statement& statement : block) {
            match(
                statement.form, [](const Let&) {},
                [&](const Store& store) { stored_[store.target] = place; },
                [&](const Spread& spread) { stored_[spread.target] = place; },
                [&](const Loop& loop) {
                    collect_stores(loop.body, inside(place, loop.variable, times_of(loop)));
                },
                [&](const Visit& visit) {
                    for (const Mark& mark : visit.marks) stored_[mark.target] = place;
                },
                [&](const Call& call) { stored_[call.output.buffer] = place; });
        }
    }

    void add(const Block& block, Place place) {
        for (const Statement& statement : block)
            match(statement.form, [&](const auto& form) { add(form, place); });
    }
    void add(const Let& let, Place place) {
        add(let.value, place);
        levels_of_local_[let.local] = levels_of(let.value, place);
    }
    void add(const Store& store, Place place) {
        add(store.value, place);
        for (const NodeId index : store.indices) add(index, place);
        pay(1, place, kind_of_value(store.value));
    }
    void add(const Spread& spread, Place place) {
        add(spread.bits, place);
        for (const NodeId index : spread.indices) add(index, place);
        pay(spread_cost, place, &PackCost::ints);
    }
    void add(const Loop& loop, Place place) {
        const double times = times_of(loop);
        pay(times, place, &PackCost::block);
        add(loop.body, inside(place, loop.variable, times));
    }
    double times_of(const Loop& loop) const {
        const double at_once = properties_.empty() ? iterations_at_once(loop) : 1;
        return std::ceil(size_of(program_, loop.variable) / at_once);
    }
    // Words of bools show which ones are true: those of the initial state, one at least.
    void add(const Visit& visit, Place place) {
        const double size = size_of(program_, visit.visited);
        pay(std::ceil(size / bools_at_once), place, &PackCost::block);
        Place each = inside(place, visit.visited, 1);
        if (visit.entries) {
            const double entries = size_of(program_, visit.entries->variable) / size;
            each = inside(each, visit.entries->variable, std::max(1.0, entries));
        }
        for (const Mark& mark : visit.marks) {
            for (const NodeId index : mark.indices) add(index, each);
            add(mark.condition, each);
            pay(1, each, &PackCost::block);
        }
    }
    // It reads its tables and fills its output.
    void add(const Call& call, Place place) {
        if (std::holds_alternative<Together>(call.callee) && properties_.empty())
            return add_together(call, place);
        for (const NodeId operand : operands_of(call)) add(operand, place);
        double elements = static_cast<double>(program_[call.output.buffer].count());
        for (const TableView& input : call.inputs)
            elements += static_cast<double>(program_[input.buffer].count());
        pay(1 + elements, place, &PackCost::reals);
    }

    // One environment computes them in registers.
    void add_together(const Call& call, Place place) {
        const auto count = static_cast<double>(call.scalars.size());
        for (const NodeId function : call.scalars)
            for (const NodeId angle : operands_of(program_[function])) add(angle, place);
        pay(std::ceil(count / angles_at_once) * cost_of_angles + count, place, &PackCost::reals);
    }

    // Pays for the node where it is computed: in the innermost of the loops on which it depends.
    void add(NodeId id, Place place) {
        const Node& node = program_[id];
        const Place where = at_level(place, levels_of(id, place));
        if (!paid_.insert({id, where}).second) return;
        pay(own_cost(program_, node), where, kind_of(id));
        const std::vector<NodeId> operands = operands_of(node);
        for (std::size_t i = 0; i < operands.size(); ++i)
            if (!is_rare(node, i)) add(operands[i], around(node, i, where));
    }
    static bool is_rare(const Node& node, std::size_t operand) {
        const auto* select = std::get_if<Select>(&node.form);
        return select && select->evaluated == Evaluated::MostlyFirst && operand == 2;
    }

    // Where an operand stands of a node at this place: the body of a binder is its first one.
    Place around(const Node& node, std::size_t operand, Place place) {
        const auto variable = bound_variable(node);
        if (!variable || operand > 0) return place;
        return inside(place, *variable, repetitions(program_, node));
    }

    Levels levels_of(NodeId id, Place place) {
        if (const auto known = levels_.find({id, place}); known != levels_.end())
            return known->second;
        const Node& node = program_[id];
        Levels levels = own_levels(node, place);
        const std::vector<NodeId> operands = operands_of(node);
        for (std::size_t i = 0; i < operands.size(); ++i) {
            const Place where = around(node, i, place);
            const Levels own = where == place ? 0 : bit_of(arounds_[where].level);
            levels |= levels_of(operands[i], where) & ~own;
        }
        return levels_[{id, place}] = levels;
    }

    Levels own_levels(const Node& node, Place place) const {
        if (const auto* index = std::get_if<Index>(&node.form))
            return level_of(index->variable, place);
        if (const auto* local = std::get_if<Local>(&node.form)) {
            const auto known = levels_of_local_.find(local->local);
            return known == levels_of_local_.end() ? 0 : known->second;
        }
        const auto buffer = buffer_read_by(node);
        const auto stored = buffer ? stored_.find(*buffer) : stored_.end();
        if (stored == stored_.end()) return 0;
        const std::size_t common = common_level(stored->second, place);
        return common == 0 ? 0 : bit_of(common);
    }
    // The level of the innermost loop around both places.
    std::size_t common_level(Place a, Place b) const {
        while (a != b) {
            Place& inner = arounds_[a].level < arounds_[b].level ? b : a;
            inner = arounds_[inner].outer;
        }
        return arounds_[a].level;
    }
    Levels level_of(VariableId variable, Place place) const {
        for (; place != outside; place = arounds_[place].outer)
            if (arounds_[place].variable == variable) return bit_of(arounds_[place].level);
        return 0;
    }
    static Levels bit_of(std::size_t level) { return Levels{1} << level; }

    // The innermost of the loops around the place on which something with these levels depends.
    Place at_level(Place place, Levels levels) const {
        const auto level = static_cast<std::size_t>(std::bit_width(levels | 1) - 1);
        while (arounds_[place].level > level) place = arounds_[place].outer;
        return place;
    }
    // Loops over the same objects share a place unless one of them takes several at once.
    Place inside(Place place, VariableId variable, double times) {
        const auto [found, is_new] = inner_.try_emplace({place, variable, times}, arounds_.size());
        if (is_new) {
            const Around& around = arounds_[place];
            arounds_.push_back({place, variable, around.level + 1, around.evaluations * times});
        }
        return found->second;
    }

    using Kind = double PackCost::*;
    void pay(double cost, Place place, Kind kind) {
        total_.*kind += cost * arounds_[place].evaluations;
    }
    bool is_uniform(NodeId id) const {
        return !properties_.empty() && properties_[id.index].uniform;
    }
    Kind kind_of_value(NodeId id) const {
        if (is_uniform(id)) return &PackCost::block;
        constexpr Kind kinds[] = {&PackCost::block, &PackCost::ints, &PackCost::reals};
        return kinds[static_cast<std::size_t>(program_[id].type)];
    }
    Kind kind_of(NodeId id) const {
        const Node& node = program_[id];
        if (is_draw(node)) return &PackCost::draws;
        std::vector<Kind> kinds = {kind_of_value(id)};
        for (const NodeId operand : operands_of(node)) kinds.push_back(kind_of_value(operand));
        for (const Kind kind : {&PackCost::reals, &PackCost::ints})
            if (std::ranges::count(kinds, kind) > 0) return kind;
        return &PackCost::block;
    }

    const Program& program_;
    std::span<const Properties> properties_;
    std::vector<Around> arounds_ = {{outside, {}, 0, 1}};
    std::map<std::tuple<Place, VariableId, double>, Place> inner_;
    std::map<std::pair<NodeId, Place>, Levels> levels_;
    std::set<std::pair<NodeId, Place>> paid_;
    std::map<LocalId, Levels> levels_of_local_;
    std::map<BufferId, Place> stored_;  // of its stores
    PackCost total_;
};

PackCost cost_of(const Program& program, std::span<const Properties> properties) {
    PackCost total;
    const auto add = [&](const BlockCost& cost, double PackCost::*block) {
        total.*block += cost.total().block;
        total.ints += cost.total().ints;
        total.reals += cost.total().reals;
        total.draws += cost.total().draws;
    };
    const auto add_computation = [&](const Computation& computation) {
        BlockCost cost(program, properties);
        cost.add_body(computation.body);
        cost.add_value(computation.value);
        add(cost, &PackCost::block);
    };
    add_computation(program.reward);
    for (const Definition& definition : program.step) {
        BlockCost cost(program, properties);
        cost.add_body(definition.body);
        add(cost, definition.unchosen ? &PackCost::unchosen : &PackCost::block);
    }
    for (const auto* conditions : {&program.invariants, &program.terminations})
        for (const Computation& condition : *conditions) add_computation(condition);
    return total;
}

}  // namespace

double iterations_at_once(const Loop& loop) {
    if (loop.as_words) return bools_at_once;
    return loop.several_at_once || loop.shifts ? objects_at_once : 1;
}

double cost_of(Operator op) {
    if (is_elementary(op)) return elementary_cost;
    const bool divides = is_one_of(
        op, {Operator::Divide, Operator::FloorDivide, Operator::FloorModulo, Operator::Sqrt});
    return divides ? division_cost : 1;
}

double own_cost(const Program& program, const Node& node) {
    return match(
        node.form, [](const Load&) { return 1.0; }, [](const Element&) { return 1.0; },
        [&](const Search& search) {
            const auto size = static_cast<double>(program[search.table].count());
            return 2 * std::ceil(std::log2(size + 1));
        },
        [&](const Bits& bits) {
            const std::int64_t count =
                program[bits.buffer].row_size(bits.indices.size()) - bits.first;
            return static_cast<double>(std::min<std::int64_t>(count, 64));
        },
        [](const Union&) { return union_cost; },
        [](const Apply& apply) { return cost_of(apply.op); }, [](const Select&) { return 1.0; },
        [&](const Reduce&) { return repetitions(program, node); },
        [&](const Sample&) { return draw_cost + (node.type == Scalar::Bool ? 0 : quantile_cost); },
        [](const Discrete& discrete) {
            return draw_cost + static_cast<double>(discrete.weights.size());
        },
        [&](const Interval& interval) {
            const auto size = static_cast<double>(program[interval.table].shape.back());
            return draw_cost + std::ceil(std::log2(size + 1));
        },
        [&](const DiscreteOver&) { return draw_cost + repetitions(program, node); },
        [](const auto&) { return 0.0; });
}

double repetitions(const Program& program, const Node& binder) {
    const auto shares = shares_of_elements(program, binder);
    if (shares && shares->is_row()) return 1;  // in the lanes of a register
    const double size = size_of(program, *bound_variable(binder));
    const auto* reduce = std::get_if<Reduce>(&binder.form);
    const bool is_row = reduce && reduce->bounds;
    return std::max(1.0, is_row ? length_of(program, *reduce->bounds, size) : size);
}

double cost_of_step(const Program& program) {
    const PackCost cost = cost_of(program, {});
    return step_cost + cost.block + cost.unchosen + cost.ints + cost.reals + cost.draws;
}

PackCost pack_cost_of_step(const Program& program) {
    return cost_of(program, all_properties(program));
}

}  // namespace rddlc::ir
