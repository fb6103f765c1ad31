#include "passes/lanes/evaluate_together.hpp"

#include "ir/analysis.hpp"
#include "ir/nest.hpp"
#include "ir/shares.hpp"
#include "passes/analyses/bool_words.hpp"
#include "passes/analyses/object_lanes.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// In operations (Properties::cost): C++ compilers put cheaper loops over reals into registers
// themselves.
constexpr double least_cost_of_reals = 4;
// The same beside ints that are computed.
constexpr double least_cost_beside_ints = 12;
// Objects that do not fill a register share one where each of them takes so many operations:
// elementary functions, draws of reals, and draws from weights do.
constexpr double least_cost_of_few_objects = 60;
// The same if each of them certainly draws by thresholds: the rounds of a random number wait for
// each other.
constexpr double least_cost_of_few_draws = 20;
constexpr std::int64_t fewest_objects = 2;
// So do reals that would jump one after the other, since processors cannot foresee where. Ints that
// jump do not pay.
constexpr std::int64_t fewest_reals_that_jump = 4;
constexpr std::int64_t objects_of_register = 8;
// And so do reals that another loop reads into a register, which waits for elements that were just
// stored one by one.
constexpr std::int64_t fewest_reals_that_wait = 4;

class Marking {
  public:
    explicit Marking(const ir::Program& program)
        : program_(program), properties_(ir::all_properties(program)) {
        for (const ir::Node& node : program.nodes) {
            const auto shares = ir::shares_of_elements(program, node);
            if (shares && shares->is_row()) rows_of_weights_.insert(shares->weight.buffer);
        }
        for (const ir::Definition& definition : program.step) {
            const auto* loop = ir::only_statement<ir::Loop>(definition.body);
            const ir::Buffer& target = program[definition.target];
            if (loop && target.storage == ir::Storage::Next &&
                !(is_worth_it(*loop) && is_possible(*loop)))
                stored_one_by_one_.insert(target.name);
        }
        while (std::ranges::any_of(program.step, [&](const ir::Definition& definition) {
            return reads_more_into_registers(definition);
        })) {
        }
    }

    // The outermost loops that can be, and the loops inside of others, whose objects are in a row.
    std::int64_t mark(ir::Block& block, bool is_inside = false) const {
        std::int64_t marked = 0;
        for (ir::Statement& statement : block) {
            auto* const loop = std::get_if<ir::Loop>(&statement.form);
            if (!loop || loop->shifts) continue;
            const bool is_right = is_worth_it(*loop) && is_possible(*loop) &&
                                  !(is_inside && computes_ints(*loop) && !loop->several_at_once) &&
                                  !waits(*loop) && !shifts_inside(*loop);
            const bool was_marked = std::exchange(loop->several_at_once, is_right);
            loop->as_words = loop->several_at_once && is_of_words(program_, *loop);
            marked += loop->several_at_once && !was_marked;
            if (!loop->several_at_once) marked += mark(loop->body, true);
        }
        return marked;
    }

  private:
    static bool shifts_inside(const ir::Loop& loop) {
        bool shifts = false;
        ir::for_each_statement<ir::Loop>(
            loop.body, [&](const ir::Loop& inner) { shifts = shifts || inner.shifts; });
        return shifts;
    }
    bool is_worth_it(const ir::Loop& loop) const {
        const ir::Nest nest = ir::nest_of(loop);
        double cost = 0;
        bool draws_or_is_bool = true;
        for (const ir::Statement& statement : *nest.body) {
            if (const auto* let = std::get_if<ir::Let>(&statement.form))
                cost += cost_of(let->value);
            const auto* store = std::get_if<ir::Store>(&statement.form);
            if (!store) continue;
            const ir::Scalar scalar = program_[store->target].scalar;
            if (scalar == ir::Scalar::Int && !is_worth_it(store->value)) return false;
            cost += cost_of(store->value);
            draws_or_is_bool &= scalar == ir::Scalar::Bool ||
                                properties_[store->value.index].random || are_weights(*store);
        }
        return draws_or_is_bool || cost >= least_cost_of_reals;
    }
    // An int that is drawn, aggregated, or made from a real, such as a sign. C++ compilers put
    // other loops over ints into registers themselves.
    bool is_worth_it(ir::NodeId id) const {
        const ir::Node& node = program_[id];
        if (properties_[id.index].random || std::holds_alternative<ir::Reduce>(node.form))
            return true;
        return std::ranges::any_of(ir::operands_of(node), [&](ir::NodeId operand) {
            return program_[operand].type == ir::Scalar::Real || is_worth_it(operand);
        });
    }
    // C++ compilers put loops that compute ints into registers themselves, if they are short.
    bool computes_ints(const ir::Loop& loop) const {
        const ir::Nest nest = ir::nest_of(loop);
        const std::vector<ir::NodeId> roots = ir::roots_of(*nest.body);
        const auto is_long = [&](ir::NodeId root) {
            return program_[root].type == ir::Scalar::Real &&
                   cost_of(root) >= least_cost_beside_ints;
        };
        if (std::ranges::any_of(roots, is_long)) return false;
        return std::ranges::any_of(roots, [&](ir::NodeId root) { return computes_ints(root); });
    }
    bool computes_ints(ir::NodeId id) const {
        const ir::Node& node = program_[id];
        if (ir::buffer_read_by(node)) return node.type == ir::Scalar::Int;
        if (node.type == ir::Scalar::Int && std::holds_alternative<ir::Apply>(node.form))
            return true;
        return std::ranges::any_of(ir::operands_of(node),
                                   [&](ir::NodeId operand) { return computes_ints(operand); });
    }
    double cost_of(ir::NodeId id) const { return properties_[id.index].cost; }

    bool is_possible(const ir::Loop& loop) const {
        const ir::Nest nest = ir::nest_of(loop);
        const ObjectLanes several(
            program_, [&](ir::NodeId id) -> const ir::Properties& { return properties_[id.index]; },
            nest);
        return std::ranges::all_of(*nest.body, [&](const ir::Statement& statement) {
            return match(
                statement.form, [&](const ir::Let& let) { return several.can_evaluate(let.value); },
                [&](const ir::Store& store) {
                    return (are_weights(store)
                                ? nest.variables.size() == 1
                                : several.are_enough(program_[store.target].scalar) ||
                                      are_expensive(nest, store)) &&
                           several.can_store_in_row(store);
                },
                [](const auto&) { return false; });
        });
    }

    // Remembers the tables of reals that a definition of few objects reads into registers; whether
    // there are new ones.
    bool reads_more_into_registers(const ir::Definition& definition) {
        const auto* loop = ir::only_statement<ir::Loop>(definition.body);
        if (!loop || program_[definition.target].scalar != ir::Scalar::Real) return false;
        const ir::Nest nest = ir::nest_of(*loop);
        const std::int64_t objects = ir::combinations(program_, nest.variables);
        if (objects < fewest_reals_that_wait || objects >= objects_of_register ||
            !is_worth_it(*loop) || !is_possible(*loop))
            return false;
        const std::size_t before = read_into_registers_.size();
        for (const ir::NodeId root : ir::roots_of(*nest.body)) {
            ir::any_node_of(program_, root, [&](ir::NodeId each) {
                const auto buffer = ir::buffer_read_by(program_[each]);
                if (buffer && is_table_of_step(program_[*buffer]))
                    read_into_registers_.insert(program_[*buffer].name);
                return false;
            });
        }
        return read_into_registers_.size() > before;
    }
    // Stored by this step or by the one before.
    static bool is_table_of_step(const ir::Buffer& buffer) {
        return buffer.scalar == ir::Scalar::Real && !buffer.shape.empty() &&
               (buffer.storage == ir::Storage::State || buffer.storage == ir::Storage::Scratch);
    }

    // A draw takes a row of them as a register, whatever they cost.
    bool are_weights(const ir::Store& store) const {
        return rows_of_weights_.contains(store.target);
    }

    bool are_expensive(const ir::Nest& nest, const ir::Store& store) const {
        const ir::Scalar scalar = program_[store.target].scalar;
        const std::int64_t objects = ir::combinations(program_, nest.variables);
        if (scalar == ir::Scalar::Bool || objects < fewest_objects) return false;
        const ir::NodeId value = named_value(*nest.body, store.value);
        const bool draws = draws_by_thresholds(value);
        const double least = draws ? least_cost_of_few_draws : least_cost_of_few_objects;
        return cost_of(value) >= least ||
               (scalar == ir::Scalar::Real && objects >= fewest_reals_that_jump && jumps(value) &&
                !reads_new_values(value)) ||
               (scalar == ir::Scalar::Real && objects >= fewest_reals_that_wait &&
                read_into_registers_.contains(program_[store.target].name));
    }
    // Draws by thresholds, or keeps a value where no draw is asked for.
    bool draws_by_thresholds(ir::NodeId id) const {
        if (std::holds_alternative<ir::Interval>(program_[id].form)) return true;
        const auto* select = std::get_if<ir::Select>(&program_[id].form);
        const auto either = [&](ir::NodeId drawn, ir::NodeId kept) {
            return std::holds_alternative<ir::Interval>(program_[drawn].form) &&
                   ir::is_cheap(properties_[kept.index]);
        };
        return select && ir::is_cheap(properties_[select->condition.index]) &&
               (either(select->then_value, select->else_value) ||
                either(select->else_value, select->then_value));
    }
    // The value that a let of the block gives this name; the node itself if it is no name.
    ir::NodeId named_value(const ir::Block& block, ir::NodeId id) const {
        const auto* local = std::get_if<ir::Local>(&program_[id].form);
        if (!local) return id;
        for (const ir::Statement& statement : block) {
            const auto* let = std::get_if<ir::Let>(&statement.form);
            if (let && let->local == local->local) return let->value;
        }
        return id;
    }
    bool jumps(ir::NodeId id) const {
        return ir::any_node_of(program_, id, [&](ir::NodeId each) {
            const auto* select = std::get_if<ir::Select>(&program_[each].form);
            return select && ir::is_lazy(program_, *select, properties_[select->then_value.index],
                                         properties_[select->else_value.index]);
        });
    }
    // Registers wait for elements that this step has just stored one by one.
    bool reads_new_values(ir::NodeId id) const {
        return ir::any_node_of(program_, id, [&](ir::NodeId each) {
            const auto buffer = ir::buffer_read_by(program_[each]);
            if (!buffer) return false;
            const ir::Storage storage = program_[*buffer].storage;
            return storage == ir::Storage::Scratch || storage == ir::Storage::Next;
        });
    }

    // Bools of few objects wait longer for ints that the step before has stored one by one than a
    // register gains, unless each object would jump.
    bool waits(const ir::Loop& loop) const {
        const ir::Nest nest = ir::nest_of(loop);
        if (ir::combinations(program_, nest.variables) >= objects_of_register) return false;
        const std::vector<ir::NodeId> roots = ir::roots_of(*nest.body);
        const auto is_other = [&](ir::NodeId root) {
            return program_[root].type == ir::Scalar::Real || properties_[root.index].random ||
                   jumps(root);
        };
        return std::ranges::none_of(roots, is_other) &&
               std::ranges::any_of(roots, [&](ir::NodeId root) {
                   return ir::any_node_of(program_, root, [&](ir::NodeId each) {
                       return is_stored_one_by_one(program_[each]);
                   });
               });
    }
    bool is_stored_one_by_one(const ir::Node& node) const {
        const auto buffer = ir::buffer_read_by(node);
        return buffer && program_[*buffer].storage == ir::Storage::State &&
               program_[*buffer].scalar == ir::Scalar::Int &&
               stored_one_by_one_.contains(program_[*buffer].name);
    }

    const ir::Program& program_;
    std::vector<ir::Properties> properties_;
    std::set<std::string> stored_one_by_one_;    // tables of the next state
    std::set<std::string> read_into_registers_;  // tables of few reals
    std::set<ir::BufferId> rows_of_weights_;
};

}  // namespace

ir::Program evaluate_together(ir::Program program, Report& report) {
    const Marking marking(program);
    std::int64_t& marked = report["loops over several objects at once"];
    for (ir::Definition& definition : program.step) marked += marking.mark(definition.body);
    marked += marking.mark(program.reward.body);
    return program;
}

}  // namespace rddlc::passes
