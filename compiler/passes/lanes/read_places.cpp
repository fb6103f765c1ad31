#include "passes/lanes/read_places.hpp"

#include "ir/nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/bool_words.hpp"
#include "passes/analyses/constant_values.hpp"
#include "passes/analyses/object_lanes.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// Aggregations that have more terms together stay loops; so does one of several terms that objects
// have less than half of on average.
constexpr std::int64_t most_terms = 8;
// One over all objects of a type has fewer terms: each of them may add a table of places.
constexpr std::int64_t most_whole_terms = 3;
// Tables of more objects are not worth their memory.
constexpr std::int64_t most_objects = 1 << 16;

using Values = std::vector<ir::Value>;

class PlaceReading {
  public:
    PlaceReading(ir::Program program, Report& report)
        : program_(std::move(program)),
          report_(report),
          builder_(program_),
          evaluator_(std::as_const(program_)) {}

    ir::Program run() && {
        for (ir::Definition& definition : program_.step) change(definition.body, definition.span);
        change(program_.reward.body, program_.reward.span);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    void change(ir::Block& block, Span span) {
        span_ = span;
        for (ir::Statement& statement : block) {
            if (auto* loop = std::get_if<ir::Loop>(&statement.form)) change(*loop);
        }
    }

    void change(ir::Loop& loop) {
        auto* const store = ir::only_statement<ir::Store>(ir::innermost_body(loop));
        if (!store || program_[store->target].scalar != ir::Scalar::Bool) return;
        nest_ = ir::nest_of(loop);
        name_ = program_[store->target].name;
        is_read_in_step_ = program_[store->target].storage == ir::Storage::Scratch;
        if (object_count() > most_objects || ir::reads(program_, store->value, store->target))
            return;

        std::map<ir::NodeId, ir::NodeId> spread;
        terms_ = 0;
        ir::NodeId value = ir::replace_in(builder_, store->value, spread,
                                          [&](ir::NodeId id) { return spread_out(id); });
        if (terms_ > most_terms) value = store->value;
        const ir::Store changed{store->target, store->indices, value};
        const ObjectLanes several(builder_, nest_,
                                  [&](ir::NodeId id) { return is_chosen(id) || is_known(id); });
        const bool is_possible = several.are_enough(ir::Scalar::Bool) &&
                                 several.can_store(changed) && !looks_up_bools(value);
        if (!is_possible) return;

        by_place_.clear();
        const ir::NodeId result = with_places(value);
        if (result == store->value) return;
        store->value = result;
        loop.several_at_once = true;
        ++report_["loops that read bools by their places"];
    }

    std::int64_t object_count() const { return ir::combinations(program_, nest_.variables); }

    // ------------------------------------------------------------------------------ finding

    // Constants and the objects of the loops decide it, and differ between objects.
    bool is_of_objects(ir::NodeId id) const {
        const ir::Properties& properties = builder_.properties(id);
        return properties.uniform && !properties.may_fault && !properties.free_variables.empty() &&
               std::ranges::all_of(properties.free_variables, [&](ir::VariableId variable) {
                   return std::ranges::find(nest_.variables, variable) != nest_.variables.end();
               });
    }
    bool is_known(ir::NodeId id) const {
        if (!is_of_objects(id) || ir::is_place_in(program_, nest_, id)) return false;
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        return !load || !is_own(*load);
    }
    bool is_own(const ir::Load& load) const {
        return ir::are_variables_of(program_, load.indices, nest_);
    }

    // An element of a table of bools that each object chooses.
    bool is_chosen(ir::NodeId id) const {
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        if (!load || program_[id].type != ir::Scalar::Bool || builder_.properties(id).uniform ||
            program_[load->buffer].count() > most_looked_up_bools)
            return false;
        const bool is_fixed = std::ranges::all_of(load->indices, [&](ir::NodeId index) {
            return is_of_objects(index) ||
                   std::holds_alternative<ir::Constant>(program_[index].form);
        });
        return is_fixed && !is_own(*load) && !is_row(*load) &&
               !builder_.properties(id).free_variables.empty();
    }
    // The objects lie next to each other in a table of more dimensions.
    bool is_row(const ir::Load& load) const {
        return ir::ends_with(program_, load.indices, nest_) &&
               std::ranges::all_of(
                   load.indices.begin(), load.indices.end() - std::ssize(nest_.variables),
                   [&](ir::NodeId index) {
                       return std::holds_alternative<ir::Constant>(program_[index].form);
                   });
    }

    // Registers gather no bools by indices that differ between objects and steps.
    bool looks_up_bools(ir::NodeId id) const {
        const ir::Node& node = program_[id];
        const auto* load = std::get_if<ir::Load>(&node.form);
        if (load && node.type == ir::Scalar::Bool && !is_own(*load) && !is_chosen(id) &&
            !is_row(*load) && !builder_.properties(id).uniform) {
            return std::ranges::any_of(load->indices, [&](ir::NodeId index) {
                return !ir::is_same_for_all(builder_.properties(index), nest_);
            });
        }
        return std::ranges::any_of(ir::operands_of(node),
                                   [&](ir::NodeId operand) { return looks_up_bools(operand); });
    }

    // ------------------------------------------------------------------------------- making

    // The terms of an exists or forall over few entries.
    std::optional<ir::NodeId> spread_out(ir::NodeId id) {
        const auto* found = std::get_if<ir::Reduce>(&program_[id].form);
        if (!found || !is_quantifier(found->op)) return std::nullopt;
        const ir::Reduce reduce = *found;
        const std::vector<Entry> entries = entries_of(reduce);
        if (entries.empty()) return std::nullopt;
        terms_ += std::ssize(entries);
        if (terms_ > most_terms) return std::nullopt;

        const bool is_exists = reduce.op == Reduction::Exists;
        ir::NodeId result = builder_.constant(!is_exists);
        for (const Entry& entry : entries) {
            std::map<ir::NodeId, ir::NodeId> entered{
                {builder_.index(reduce.variable), entry.number}};
            std::map<ir::NodeId, ir::NodeId> spread;
            const ir::NodeId body =
                ir::replace_in(builder_, ir::replace_in(builder_, reduce.body, entered), spread,
                               [&](ir::NodeId inner) { return spread_out(inner); });
            const ir::NodeId term = is_exists
                                        ? builder_.apply(Operator::And, {entry.is_there, body})
                                        : builder_.apply(Operator::Implies, {entry.is_there, body});
            result = builder_.apply(is_exists ? Operator::Or : Operator::And, {result, term});
        }
        return result;
    }

    // The number of an entry by object, and whether the object has it.
    struct Entry {
        ir::NodeId number, is_there;
    };
    // Empty if they are too many, or not known.
    std::vector<Entry> entries_of(const ir::Reduce& reduce) {
        std::vector<Entry> entries;
        if (!reduce.bounds) return all_entries_of(reduce);
        const auto begins = values_of(reduce.bounds->begin), ends = values_of(reduce.bounds->end);
        if (!begins || !ends) return {};
        std::int64_t most = 0, all = 0;
        for (std::size_t i = 0; i < begins->size(); ++i) {
            const std::int64_t length = int_of((*ends)[i]) - int_of((*begins)[i]);
            most = std::max(most, length);
            all += length;
        }
        if (most > 1 && 2 * all < most * std::ssize(*begins)) return {};
        for (std::int64_t k = 0; k < most && most <= most_terms; ++k) {
            Values numbers, there;
            // An object without the entry reads that of the object before: equal places are read
            // fast.
            std::int64_t last = 0;
            for (std::size_t i = 0; i < begins->size(); ++i) {
                const std::int64_t number = int_of((*begins)[i]) + k;
                const bool is_there = number < int_of((*ends)[i]);
                if (is_there) last = number;
                numbers.emplace_back(last);
                there.emplace_back(is_there);
            }
            entries.push_back({table("entries", ir::Scalar::Int, std::move(numbers)),
                               table("table", ir::Scalar::Bool, std::move(there))});
        }
        return entries;
    }

    std::vector<Entry> all_entries_of(const ir::Reduce& reduce) {
        std::vector<Entry> entries;
        const std::int64_t count = program_[reduce.variable].size;
        if (count > most_whole_terms || !(is_read_in_step_ || are_many(program_, nest_))) return {};
        for (std::int64_t k = 0; k < count; ++k)
            entries.push_back({builder_.constant(k), builder_.constant(true)});
        return entries;
    }

    // By object, if constants decide them.
    std::optional<Values> values_of(ir::NodeId id) {
        const ir::Properties& properties = builder_.properties(id);
        if (!is_of_objects(id) && !(properties.uniform && properties.free_variables.empty()))
            return std::nullopt;
        evaluator_.know_added_tables();
        return constant_values(evaluator_, program_, id, nest_.variables);
    }
    static std::int64_t int_of(const ir::Value& value) { return std::get<std::int64_t>(value); }

    ir::NodeId with_places(ir::NodeId id) {
        return ir::replace_in(builder_, id, by_place_,
                              [&](ir::NodeId each) { return by_place(each); });
    }

    std::optional<ir::NodeId> by_place(ir::NodeId id) {
        if (is_known(id)) return table("table", program_[id].type, *values_of(id));
        if (ir::is_place_in(program_, nest_, id)) return id;
        const auto* found = std::get_if<ir::Load>(&program_[id].form);
        if (!found) return std::nullopt;
        ir::Load load = *found;
        if (is_row(load)) return id;
        if (!is_chosen(id) && ir::begins_with(program_, load.indices, nest_)) {
            for (std::size_t axis = nest_.variables.size(); axis < load.indices.size(); ++axis)
                load.indices[axis] = with_places(load.indices[axis]);
            return builder_.load(load.buffer, std::move(load.indices));
        }
        if (!is_chosen(id)) return std::nullopt;
        ir::NodeId place = builder_.constant(std::int64_t{0});
        for (std::size_t axis = 0; axis < load.indices.size(); ++axis) {
            const ir::NodeId size = builder_.constant(program_[load.buffer].shape[axis]);
            place = builder_.apply(
                Operator::Add,
                {builder_.apply(Operator::Multiply, {place, size}), load.indices[axis]});
        }
        return builder_.element(load.buffer, table("places", ir::Scalar::Int, *values_of(place)));
    }

    // An element of a table by object.
    ir::NodeId table(const std::string& what, ir::Scalar scalar, Values values) {
        const bool are_places = what == "places";
        const bool are_equal = std::ranges::all_of(
            values, [&](const ir::Value& value) { return identical(value, values.front()); });
        if (are_equal && !are_places) return builder_.constant(values.front());
        ir::Buffer buffer{.name = name_ + "-" + what,
                          .storage = ir::Storage::Constant,
                          .scalar = scalar,
                          .values = std::move(values),
                          .span = span_,
                          .holds_places = are_places};
        ir::set_dimensions(program_, buffer, nest_.variables);
        std::vector<ir::NodeId> indices;
        for (const ir::VariableId variable : nest_.variables)
            indices.push_back(builder_.index(variable));
        return builder_.load(builder_.tables().constant(std::move(buffer)), std::move(indices));
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    ir::Evaluator evaluator_;

    // Members of the loop at hand.
    ir::Nest nest_;
    std::string name_;              // of what it fills
    bool is_read_in_step_ = false;  // so registers do not wait for bools that are stored one by one
    Span span_;
    std::int64_t terms_ = 0;  // of its aggregations
    std::map<ir::NodeId, ir::NodeId> by_place_;
};

}  // namespace

ir::Program read_places(ir::Program program, Report& report) {
    return PlaceReading(std::move(program), report).run();
}

}  // namespace rddlc::passes
