#include "passes/aggregations/fuse_interm_fluents.hpp"

#include "ir/rewrite.hpp"
#include "passes/analyses/plain_definition.hpp"
#include "passes/analyses/readers.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <utility>

namespace rddlc::passes {
namespace {

// An expression of more operations (Properties::cost) is not repeated where it is read in several
// places.
constexpr double cheap_to_repeat = 2;
// A single value that takes more is worth a name. As is what share_subexpressions would name.
constexpr double worth_a_definition = 6;
// Passes walk through expressions as trees: each fluent of a chain that the next one reads twice
// would double them.
constexpr double most_with_a_name = 128;

class Fusion {
  public:
    Fusion(ir::Program program, Report& report)
        : program_(std::move(program)),
          report_(report),
          readers_(readers_of_step(program_)),
          builder_(program_) {}

    // The definitions are visited in the order of evaluation, so a fused expression already has its
    // own reads fused.
    ir::Program run() && {
        const ir::Change fuse = [&](ir::NodeId& root) {
            root = fused(root);
        };
        for (ir::Definition& definition : program_.step) {
            ir::change_roots(definition.body, fuse);
            consider(definition);
        }
        ir::change_roots(program_.reward.body, fuse);
        fuse(program_.reward.value);
        std::erase_if(program_.step, [&](const ir::Definition& definition) {
            return fluents_.contains(definition.target);
        });
        return ir::collect_garbage(std::move(program_));
    }

  private:
    void consider(const ir::Definition& definition) {
        const ir::Buffer& buffer = program_[definition.target];
        const Readers& readers = readers_[definition.target.index];
        if (buffer.storage != ir::Storage::Scratch || readers.functions || readers.reads == 0)
            return;
        auto plain = plain_definition(program_, definition);
        if (!plain || !is_worth_it(builder_.properties(plain->value), readers, buffer) ||
            !may_move(plain->value, readers))
            return;
        ++report_["interm-fluents fused"];
        fluents_[definition.target] = *std::move(plain);
    }

    static bool is_worth_it(const ir::Properties& properties, const Readers& readers,
                            const ir::Buffer& buffer) {
        // share_subexpressions gives a name to what one definition reads by the same indices.
        const bool gets_a_name = readers.definitions == 1 && readers.loads.size() == 1 &&
                                 !readers.lazy && properties.cost <= most_with_a_name;
        if (readers.places > 1 && !gets_a_name && properties.cost > cheap_to_repeat) return false;
        if (buffer.count() == 1 && properties.cost > worth_a_definition) return false;
        const double before =
            static_cast<double>(buffer.count()) * (properties.cost + 1) + readers.reads;
        return readers.reads * properties.cost <= before;
    }

    // Into all of its readers.
    bool may_move(ir::NodeId value, const Readers& readers) const {
        const ir::Properties& properties = builder_.properties(value);
        if (properties.may_fault || reads_what_functions_use(value)) return false;
        if (readers.lazy && repeats_something(value)) return false;
        const std::set<ir::VariableId> bound = bound_variables(program_, value);
        const auto is_bound_there = [&](ir::VariableId variable) {
            return readers.variables.contains(variable);
        };
        if (std::ranges::any_of(bound, is_bound_there)) return false;
        // A fault of an index would be lost where the value does not depend on it. The place of a
        // draw is known to the compiler.
        const auto is_plain = [&](ir::NodeId index) {
            const ir::Properties& known = builder_.properties(index);
            return !known.may_fault && (!properties.random || known.uniform);
        };
        return std::ranges::all_of(readers.loads, [&](ir::NodeId load) {
            return std::ranges::all_of(std::get<ir::Load>(program_[load].form).indices, is_plain);
        });
    }

    // There, share_subexpressions could give it no name.
    bool repeats_something(ir::NodeId value) const {
        // Users come before what they use.
        std::map<ir::NodeId, int, std::greater<>> uses = {{value, 1}};
        for (; !uses.empty(); uses.erase(uses.begin())) {
            const auto [id, count] = *uses.begin();
            if (count > 1 && builder_.properties(id).cost >= worth_a_definition) return true;
            for (ir::NodeId operand : ir::operands_of(program_[id])) ++uses[operand];
        }
        return false;
    }

    bool reads_what_functions_use(ir::NodeId id) const {
        return ir::any_node_of(program_, id, [&](ir::NodeId each) {
            const auto* load = std::get_if<ir::Load>(&program_[each].form);
            return load && readers_[load->buffer.index].functions;
        });
    }

    ir::NodeId fused(ir::NodeId id) {
        if (const auto known = done_.find(id); known != done_.end()) return known->second;
        ir::Node node = program_[id];
        ir::change_operands(node, [&](ir::NodeId& operand) { operand = fused(operand); });
        const auto* load = std::get_if<ir::Load>(&node.form);
        const auto fluent = load ? fluents_.find(load->buffer) : fluents_.end();
        if (fluent == fluents_.end()) return done_[id] = builder_.rebuild(node);
        return done_[id] = element(fluent->second, load->indices);
    }

    ir::NodeId element(const PlainDefinition& fluent, const std::vector<ir::NodeId>& indices) {
        std::map<ir::NodeId, ir::NodeId> known;
        for (std::size_t axis = 0; axis < indices.size(); ++axis) {
            if (!fluent.variables[axis]) continue;
            known[builder_.index(*fluent.variables[axis])] = indices[axis];
        }
        return ir::replace_in(builder_, fluent.value, known);
    }

    ir::Program program_;
    Report& report_;
    std::vector<Readers> readers_;
    ir::Builder builder_;
    std::map<ir::BufferId, PlainDefinition> fluents_;
    std::map<ir::NodeId, ir::NodeId> done_;
};

}  // namespace

ir::Program fuse_interm_fluents(ir::Program program, Report& report) {
    return Fusion(std::move(program), report).run();
}

}  // namespace rddlc::passes
