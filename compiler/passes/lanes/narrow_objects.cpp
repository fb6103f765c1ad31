#include "passes/lanes/narrow_objects.hpp"

#include "ir/nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/constant_values.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// Loops over more take the compiler too long.
constexpr std::int64_t most_narrowed_objects = 1 << 12;

// Which objects of a loop, in row-major order.
using Objects = std::vector<bool>;

Objects both(Objects a, const Objects& b, bool is_true) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] = a[i] && b[i] == is_true;
    return a;
}
bool are_none(const Objects& objects) {
    return std::ranges::find(objects, true) == objects.end();
}

// The places of a table, all less than `limit`, and which of them an object reads.
struct Places {
    std::vector<std::int64_t> values;
    Objects read;
    std::int64_t limit;
};

bool agree(const Places& a, const Places& b) {
    if (a.limit != b.limit || a.values.size() != b.values.size()) return false;
    for (std::size_t i = 0; i < a.values.size(); ++i)
        if (a.read[i] && b.read[i] && a.values[i] != b.values[i]) return false;
    return true;
}
void join(Places& all, const Places& others) {
    for (std::size_t i = 0; i < all.values.size(); ++i) {
        if (others.read[i]) all.values[i] = others.values[i];
        all.read[i] = all.read[i] || others.read[i];
    }
}
// Places that no object reads continue those beside them, by steps of 1 where that leads to the
// next ones, else by equal ones.
void fill_gaps(Places& places) {
    const auto count = std::ssize(places.values);
    const auto at = [&](std::ptrdiff_t i) -> std::int64_t& {
        return places.values[static_cast<std::size_t>(i)];
    };
    const auto is_read = [&](std::ptrdiff_t i) {
        return places.read[static_cast<std::size_t>(i)];
    };
    std::ptrdiff_t begin = 0;  // of those that are not filled yet
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        if (!is_read(i)) continue;
        const bool is_line = begin == 0 ? at(i) >= i : at(i) - at(begin - 1) == i - begin + 1;
        for (std::ptrdiff_t gap = begin; gap < i; ++gap)
            at(gap) = is_line ? at(i) - (i - gap) : at(begin == 0 ? i : begin - 1);
        begin = i + 1;
    }
    for (; 0 < begin && begin < count; ++begin) at(begin) = at(begin - 1);
}

class Narrowing {
  public:
    Narrowing(ir::Program program, Report& report)
        : program_(std::move(program)),
          report_(report),
          builder_(program_),
          evaluator_(std::as_const(program_)) {}

    ir::Program run() && {
        for (ir::Definition& definition : program_.step) change(definition.body);
        change(program_.reward.body);
        join_places();
        keep_names();
        return ir::collect_garbage(std::move(program_));
    }

  private:
    void change(ir::Block& block) {
        for (ir::Statement& statement : block) {
            auto* const loop = std::get_if<ir::Loop>(&statement.form);
            if (loop == nullptr) continue;
            auto* const store = ir::only_statement<ir::Store>(ir::innermost_body(*loop));
            nest_ = ir::nest_of(*loop);
            const std::int64_t count = ir::combinations(program_, nest_.variables);
            if (store == nullptr || count > most_narrowed_objects) continue;
            known_.clear();
            narrowed_.clear();
            const ir::NodeId value =
                narrowed(store->value, Objects(static_cast<std::size_t>(count), true));
            report_["loops that know their constants in branches"] += value != store->value;
            store->value = value;
            stores_.push_back(store);
        }
    }

    // ------------------------------------------------------------------------------- values

    // Its value for each object, if only constants decide it.
    const std::optional<Objects>& known(ir::NodeId id) {
        const auto [found, is_new] = known_.try_emplace(id);
        const ir::Properties& properties = builder_.properties(id);
        const bool may_be = is_new && program_[id].type == ir::Scalar::Bool && properties.uniform &&
                            ir::is_droppable(properties) && !properties.free_variables.empty() &&
                            ir::depends_on_none_but(properties, nest_.variables);
        if (!may_be) return found->second;
        evaluator_.know_added_tables();
        if (const auto values = constant_values(evaluator_, program_, id, nest_.variables)) {
            found->second.emplace();
            for (const ir::Value& value : *values) found->second->push_back(std::get<bool>(value));
        }
        return found->second;
    }

    // An expression that has the same values for these objects, which alone use them. It evaluates
    // nothing for others that may fault or draw, where it did not before.
    ir::NodeId narrowed(ir::NodeId id, const Objects& objects) {
        const auto [found, is_new] = narrowed_.try_emplace({id, objects}, id);
        if (is_new) found->second = narrowed_anew(id, objects);
        return found->second;
    }
    ir::NodeId narrowed_anew(ir::NodeId id, const Objects& objects) {
        if (const auto& values = known(id)) {
            if (are_none(both(objects, *values, true))) return builder_.constant(false);
            if (are_none(both(objects, *values, false))) return builder_.constant(true);
            return id;
        }
        note_places(id, objects);
        const ir::Node node = program_[id];
        if (const auto* select = std::get_if<ir::Select>(&node.form))
            return narrowed_select(*select, objects);
        const auto* apply = std::get_if<ir::Apply>(&node.form);
        if (apply && (apply->op == Operator::And || apply->op == Operator::Or))
            return narrowed_chain(id, apply->op, objects);
        return with_narrowed_operands(node, objects);
    }

    ir::NodeId with_narrowed_operands(ir::Node node, const Objects& objects) {
        ir::change_operands(node,
                            [&](ir::NodeId& operand) { operand = narrowed(operand, objects); });
        return builder_.rebuild(node);
    }

    ir::NodeId narrowed_select(const ir::Select& select, const Objects& objects) {
        const auto condition = known(select.condition);
        const Objects then_objects = condition ? both(objects, *condition, true) : objects,
                      else_objects = condition ? both(objects, *condition, false) : objects;
        if (are_none(then_objects)) return narrowed(select.else_value, objects);
        if (are_none(else_objects)) return narrowed(select.then_value, objects);
        const ir::NodeId test = narrowed(select.condition, objects);
        const ir::NodeId then_value = narrowed(select.then_value, then_objects);
        const ir::NodeId else_value = narrowed(select.else_value, else_objects);
        return builder_.select(test, then_value, else_value, select.evaluated);
    }

    // Parts matter for objects that the constants do not decide: those before a part that is a
    // constant itself, and all of them for other parts.
    ir::NodeId narrowed_chain(ir::NodeId id, Operator op, const Objects& objects) {
        const std::vector<ir::NodeId> parts = ir::parts_of(program_, id, op);
        std::map<ir::NodeId, ir::NodeId> others;
        Objects undecided = objects;
        for (const ir::NodeId part : parts) {
            const auto values = known(part);
            if (!values || others.contains(part)) continue;
            others[part] = narrowed(part, undecided);
            undecided = both(std::move(undecided), *values, op == Operator::And);
        }
        for (const ir::NodeId part : parts) {
            if (known(part)) continue;
            const bool is_plain = ir::is_droppable(builder_.properties(part));
            others[part] = narrowed(part, is_plain ? undecided : objects);
        }
        return ir::replace_in(builder_, id, others);
    }

    // ------------------------------------------------------------------------------- places

    // The table of places by which an element is read, at the objects of the loop. Elements of
    // constants keep theirs: what they decide is also known for objects that do not reach them.
    const ir::Load* place_of(const ir::Element& element) const {
        if (program_[element.buffer].storage == ir::Storage::Constant || !element.indices.empty())
            return nullptr;
        const auto* load = std::get_if<ir::Load>(&program_[element.place].form);
        const bool is_own = load && program_[load->buffer].storage == ir::Storage::Constant &&
                            ir::are_variables_of(program_, load->indices, nest_);
        return is_own ? load : nullptr;
    }
    void note_places(ir::NodeId id, const Objects& objects) {
        const auto* element = std::get_if<ir::Element>(&program_[id].form);
        const ir::Load* const load = element ? place_of(*element) : nullptr;
        if (load == nullptr) return;
        const std::int64_t limit = program_[element->buffer].count();
        elements_.insert(id);
        const auto [found, is_new] = places_.try_emplace(load->buffer);
        Places& places = found->second;
        if (is_new) {
            places = {{}, Objects(objects.size()), limit};
            for (const ir::Value& value : program_[load->buffer].values.dense())
                places.values.push_back(std::get<std::int64_t>(value));
        }
        places.limit = std::min(places.limit, limit);
        for (std::size_t i = 0; i < objects.size(); ++i)
            places.read[i] = places.read[i] || objects[i];
    }

    // Tables that agree become one, in all loops.
    void join_places() {
        struct Group {
            ir::BufferId first;
            Places places;
        };
        std::vector<Group> groups;
        std::map<ir::BufferId, std::size_t> group_of;
        for (const auto& noted : places_) {
            const ir::BufferId table = noted.first;
            const Places& places = noted.second;
            const auto group = std::ranges::find_if(groups, [&](const Group& each) {
                return program_[each.first].types == program_[table].types &&
                       program_[each.first].shape == program_[table].shape &&
                       agree(each.places, places);
            });
            group_of[table] = static_cast<std::size_t>(group - groups.begin());
            if (group == groups.end())
                groups.push_back({table, places});
            else
                join(group->places, places);
        }
        std::vector<ir::BufferId> joined;
        for (Group& group : groups) {
            fill_gaps(group.places);
            joined.push_back(with_places(group.first, group.places));
        }
        std::map<ir::NodeId, ir::NodeId> replaced;
        for (const ir::NodeId id : elements_) {
            const ir::Element element = std::get<ir::Element>(program_[id].form);
            const ir::Load load = std::get<ir::Load>(program_[element.place].form);
            const ir::BufferId table = joined[group_of.at(load.buffer)];
            replaced[id] = builder_.element(element.buffer, builder_.load(table, load.indices));
        }
        for (ir::Store* const store : stores_)
            store->value = ir::replace_in(builder_, store->value, replaced);
    }
    ir::BufferId with_places(ir::BufferId former, const Places& places) {
        ir::Buffer table = program_[former];
        table.values = std::vector<ir::Value>(places.values.begin(), places.values.end());
        const ir::BufferId result = builder_.tables().constant(std::move(table));
        former_.try_emplace(result, former);
        return result;
    }
    // Tables keep the names of those whose place they take, if nothing reads these any more.
    void keep_names() {
        std::set<ir::BufferId> read;
        const std::vector<bool> reachable = ir::reachable_nodes(program_);
        for (std::uint32_t i = 0; i < reachable.size(); ++i)
            if (const auto buffer = ir::buffer_read_by(program_[ir::NodeId{i}]);
                reachable[i] && buffer)
                read.insert(*buffer);
        for (const auto& [joined, former] : former_)
            if (!read.contains(former))
                std::swap(program_.buffers[joined.index].name, program_.buffers[former.index].name);
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    ir::Evaluator evaluator_;

    // Members of the loop at hand.
    ir::Nest nest_;
    std::map<ir::NodeId, std::optional<Objects>> known_;
    std::map<std::pair<ir::NodeId, Objects>, ir::NodeId> narrowed_;

    // Members of all loops: their statements, and what these read by places.
    std::vector<ir::Store*> stores_;
    std::set<ir::NodeId> elements_;
    std::map<ir::BufferId, Places> places_;
    std::map<ir::BufferId, ir::BufferId> former_;  // by the table that takes its place
};

}  // namespace

ir::Program narrow_objects(ir::Program program, Report& report) {
    return Narrowing(std::move(program), report).run();
}

}  // namespace rddlc::passes
