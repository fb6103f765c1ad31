#include "passes/lanes/visit_affected.hpp"

#include "ir/builder.hpp"
#include "ir/nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/bool_words.hpp"
#include "passes/analyses/few_true.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// More objects that one bool affects, on average, take longer than all in registers.
constexpr std::int64_t most_affected = 8;

class Affecting {
  public:
    Affecting(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        ir::for_each_loop(program_, [&](ir::Loop& loop, Span span) { change(loop, span); });
        return ir::collect_garbage(std::move(program_));
    }

  private:
    void change(ir::Loop& loop, Span span) {
        const ir::Nest nest = ir::nest_of(loop);
        const auto* store = ir::only_statement<ir::Store>(*nest.body);
        if (loop.affected || !loop.as_words || !store || !are_many(program_, nest)) return;
        // Without draws, all objects in registers take few instructions.
        if (!builder_.properties(store->value).random) return;
        for (const ir::BufferId few : ir::buffers_read_by(program_, {store->value})) {
            if (!is_few(few, nest) || !is_false_without(few, store->value, nest)) continue;
            const auto readers = readers_of(few, store->value, nest);
            if (!readers) continue;
            loop.affected = affected_by(few, *readers, span);
            ++report_["loops over the objects that few bools affect"];
            return;
        }
    }

    bool is_few(ir::BufferId id, const ir::Nest& nest) const {
        const ir::Buffer& buffer = program_[id];
        return buffer.count() == ir::combinations(program_, nest.variables) &&
               begins_with_few_true(buffer, least_per_visit);
    }

    // An object's own element, or one that its place chooses.
    bool is_read_by_object(ir::NodeId id, ir::BufferId few, const ir::Nest& nest) const {
        if (const auto* load = std::get_if<ir::Load>(&program_[id].form))
            return load->buffer == few && ir::begins_with(program_, load->indices, nest);
        const auto* element = std::get_if<ir::Element>(&program_[id].form);
        return element && element->buffer == few && element->indices.empty();
    }

    bool is_false_without(ir::BufferId few, ir::NodeId value, const ir::Nest& nest) {
        std::map<ir::NodeId, ir::NodeId> known;
        const ir::NodeId rest =
            ir::replace_in(builder_, value, known, [&](ir::NodeId id) -> std::optional<ir::NodeId> {
                if (!is_read_by_object(id, few, nest)) return std::nullopt;
                return builder_.constant(false);
            });
        return ir::constant<bool>(program_, rest) == false;
    }

    // By element of the table: the objects that read it.
    using Objects = std::vector<std::set<std::int64_t>>;
    std::optional<Objects> readers_of(ir::BufferId few, ir::NodeId value, const ir::Nest& nest) {
        const std::int64_t count = program_[few].count();
        Objects readers(static_cast<std::size_t>(count));
        if (!collect_readers(few, value, nest, readers)) return std::nullopt;
        std::int64_t all = 0;
        for (const std::set<std::int64_t>& each : readers) all += std::ssize(each);
        if (all > most_affected * count) return std::nullopt;
        return readers;
    }
    bool collect_readers(ir::BufferId few, ir::NodeId id, const ir::Nest& nest, Objects& readers) {
        if (is_read_by_object(id, few, nest)) {
            const auto* element = std::get_if<ir::Element>(&program_[id].form);
            const auto* places =
                element ? std::get_if<ir::Load>(&program_[element->place].form) : nullptr;
            // A table of places for each term of an aggregation is not one for each object.
            if (element && (!places || !ir::are_variables_of(program_, places->indices, nest)))
                return false;
            for (std::int64_t object = 0; object < std::ssize(readers); ++object) {
                const std::int64_t place =
                    places ? std::get<std::int64_t>(program_[places->buffer].values[object])
                           : object;
                readers[static_cast<std::size_t>(place)].insert(object);
            }
            return true;
        }
        return std::ranges::all_of(ir::operands_of(program_[id]), [&](ir::NodeId operand) {
            return collect_readers(few, operand, nest, readers);
        });
    }

    ir::Affected affected_by(ir::BufferId few, const Objects& readers, Span span) {
        std::vector<ir::Value> begins, objects;
        for (const std::set<std::int64_t>& each : readers) {
            begins.emplace_back(std::ssize(objects));
            for (const std::int64_t object : each) objects.emplace_back(object);
        }
        begins.emplace_back(std::ssize(objects));
        const std::string name = program_[few].name + "-affects";
        return {few, builder_.tables().list(name + "-rows", ir::Scalar::Int, begins, span),
                builder_.tables().list(name, ir::Scalar::Int, objects, span)};
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
};

}  // namespace

ir::Program visit_affected(ir::Program program, Report& report) {
    return Affecting(std::move(program), report).run();
}

}  // namespace rddlc::passes
