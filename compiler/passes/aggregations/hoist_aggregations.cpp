#include "passes/aggregations/hoist_aggregations.hpp"

#include "ir/call.hpp"
#include "ir/cost_model.hpp"
#include "ir/fill_table.hpp"
#include "ir/rewrite.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// Operations (Properties::cost) of an expression that is worth a table, and of writing or reading
// an element.
constexpr double worth_hoisting = 8;
constexpr double cost_of_element = 2;
// The work must shrink to less than this part, since branches may skip some of it.
constexpr double worthwhile = 0.5;
// The same where a constant table chooses the objects, of sums of so many operations. Such sums
// mostly stand in branches, and sparse rows make short ones cheap. Both numbers are fitted
// (docs/decisions.md).
constexpr double worthwhile_by_table = 0.44, worth_choosing = 100;

using Variables = std::vector<ir::VariableId>;

class Hoisting {
  public:
    Hoisting(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        hoist_in(program_.step);
        hoist_in(program_.reward);
        if (program_.policy) {
            elements_.clear();  // the step has tables of its own
            replaced_.clear();
            visited_.clear();
            hoist_in(program_.policy->act);
        }
        return ir::collect_garbage(std::move(program_));
    }

  private:
    void hoist_in(std::vector<ir::Definition>& definitions) {
        for (ir::Definition& definition : definitions) {
            name_ = program_[definition.target].name;
            span_ = definition.span;
            definition.body = hoisted(std::move(definition.body));
        }
    }

    // The value is one more statement, outside of all loops.
    void hoist_in(ir::Computation& computation) {
        name_ = "reward";
        span_ = computation.span;
        computation.body = hoisted(std::move(computation.body));
        filled_.clear();
        find_tables(computation.value, {}, 0, computation.body);
        computation.value = replaced(computation.value);
    }

    ir::Block hoisted(ir::Block block) {
        ir::Block result;
        for (ir::Statement& statement : block) {
            ir::Block single;
            single.push_back(std::move(statement));
            filled_ = ir::written_buffers(single);
            find_tables(single, {}, result);
            ir::change_roots(single, [&](ir::NodeId& root) { root = replaced(root); });
            result.push_back(std::move(single.front()));
        }
        return result;
    }

    // --------------------------------------------------------------------------- finding

    // Puts the statements that fill new tables into `before`.
    void find_tables(const ir::Block& block, const Variables& around, ir::Block& before) {
        for (const ir::Statement& statement : block) {
            match(
                statement.form,
                [&](const ir::Loop& loop) {
                    Variables inner = around;
                    inner.push_back(loop.variable);
                    find_tables(loop.body, inner, before);
                },
                [&](const ir::Let& let) { find_tables(let.value, around, around.size(), before); },
                [&](const ir::Store& store) {
                    find_tables(store.value, around, around.size(), before);
                },
                [](const ir::Spread&) {}, [](const ir::Visit&) {}, [](const ir::Call&) {});
        }
    }

    // `around` are all loops and aggregations around the node, outermost first, of which `loops`
    // are statements.
    void find_tables(ir::NodeId id, const Variables& around, std::size_t loops, ir::Block& before) {
        if (elements_.contains(id) || !visited_.emplace(id, around).second) return;
        if (is_worthwhile(id, around, loops)) return make_table(id, around, before);
        if (const auto chosen = chosen_by_table(id, around)) return make_table(id, *chosen, before);
        const ir::Node node = program_[id];
        const auto variable = ir::bound_variable(node);
        const std::vector<ir::NodeId> operands = ir::operands_of(node);
        for (ir::NodeId operand : operands) {
            Variables inner = around;
            if (variable && operand == operands.front()) inner.push_back(*variable);
            find_tables(operand, inner, loops, before);
        }
    }

    bool is_worthwhile(ir::NodeId id, const Variables& around, std::size_t loops) const {
        const ir::Properties& properties = builder_.properties(id);
        if (properties.may_fault || properties.uniform || properties.cost < worth_hoisting)
            return false;
        if (properties.free_variables.empty() || is_fixed_by_loops(id, around, loops)) return false;
        const double entries = product_of_sizes(properties.free_variables);
        return is_worth_a_table(properties.cost, entries, around) &&
               ir::is_known_before(program_, id, filled_);
    }
    bool is_worth_a_table(double cost, double entries, const Variables& around,
                          double part = worthwhile) const {
        const double evaluations = product_of_sizes(around);
        const double hoisted = entries * (cost + cost_of_element) + evaluations * cost_of_element;
        return entries <= ir::most_new_elements && hoisted < part * evaluations * cost;
    }

    // A sum that one object decides, through an element of a constant table, f(OWNER[t]):
    // what that is of the objects that the element chooses.
    struct Chosen {
        ir::NodeId element;
        ir::VariableId object;
        ir::NodeId value;
    };
    std::optional<Chosen> chosen_by_table(ir::NodeId id, const Variables& around) {
        const ir::Properties properties = builder_.properties(id);
        const auto* sum = std::get_if<ir::Reduce>(&program_[id].form);
        if (!sum || sum->op != Reduction::Sum || properties.uniform ||
            properties.cost < worth_choosing || !ir::is_droppable(properties) ||
            properties.free_variables.size() != 1 || !ir::is_known_before(program_, id, filled_))
            return std::nullopt;
        const auto element = element_by_table(id, builder_.index(properties.free_variables[0]));
        if (!element) return std::nullopt;
        const auto [place, type] = *element;
        const double entries = static_cast<double>(program_.types[type].objects.size());
        if (!is_worth_a_table(properties.cost, entries, around, worthwhile_by_table))
            return std::nullopt;
        const ir::VariableId object = object_of(type);
        std::map<ir::NodeId, ir::NodeId> known = {{place, builder_.index(object)}};
        const ir::NodeId value = ir::replace_in(builder_, id, known);
        if (builder_.properties(value).free_variables != Variables{object}) return std::nullopt;
        return Chosen{place, object, value};
    }
    // The first index that is an element of a constant table at the object, and of which type the
    // objects are that it chooses.
    std::optional<std::pair<ir::NodeId, std::uint32_t>> element_by_table(ir::NodeId id,
                                                                         ir::NodeId object) const {
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        for (std::size_t k = 0; load && k < program_[load->buffer].types.size(); ++k) {
            const auto* index = std::get_if<ir::Load>(&program_[load->indices[k]].form);
            if (index && index->indices == std::vector{object} &&
                program_[index->buffer].storage == ir::Storage::Constant)
                return std::pair{load->indices[k], program_[load->buffer].types[k]};
        }
        for (const ir::NodeId operand : ir::operands_of(program_[id]))
            if (const auto found = element_by_table(operand, object)) return found;
        return std::nullopt;
    }
    // A loop index over the objects of a type that no expression has.
    ir::VariableId object_of(std::uint32_t type) {
        const auto [object, is_new] = objects_.try_emplace(
            type, ir::VariableId{static_cast<std::uint32_t>(program_.variables.size())});
        if (is_new)
            program_.variables.push_back(
                {program_.types[type].name, type, std::ssize(program_.types[type].objects)});
        return object->second;
    }

    // It depends on outer loops alone.
    bool is_fixed_by_loops(ir::NodeId id, const Variables& around, std::size_t loops) const {
        const auto& variables = builder_.properties(id).free_variables;
        return std::all_of(variables.begin(), variables.end(), [&](ir::VariableId variable) {
            const auto place =
                static_cast<std::size_t>(std::ranges::find(around, variable) - around.begin());
            return place < std::min(loops, variables.size());
        });
    }

    double product_of_sizes(const Variables& variables) const {
        double product = 1;
        for (ir::VariableId variable : variables) {
            product *= static_cast<double>(program_[variable].size);
        }
        return product;
    }

    // ---------------------------------------------------------------------------- making

    void make_table(ir::NodeId id, const Variables& around, ir::Block& before) {
        Variables dimensions;
        for (ir::VariableId variable : around) {
            const auto& needed = builder_.properties(id).free_variables;
            if (std::ranges::binary_search(needed, variable)) dimensions.push_back(variable);
        }
        // The parts of its value may also become tables.
        for (ir::NodeId operand : ir::operands_of(program_[id])) {
            Variables inner = dimensions;
            const auto variable = ir::bound_variable(program_[id]);
            if (variable && operand == ir::operands_of(program_[id]).front()) {
                inner.push_back(*variable);
            }
            find_tables(operand, inner, dimensions.size(), before);
        }
        const ir::BufferId table = new_table(id, dimensions);
        elements_[id] = ir::fill_table(builder_, before, table, dimensions, replaced(id));
        replaced_.clear();
        ++report_["tables filled before loops"];
    }
    void make_table(ir::NodeId id, const Chosen& chosen, ir::Block& before) {
        const Variables dimensions = {chosen.object};
        const ir::BufferId table = new_table(id, dimensions);
        ir::fill_table(builder_, before, table, dimensions, chosen.value);
        elements_[id] = builder_.load(table, {chosen.element});
        replaced_.clear();
        ++report_["tables filled before loops"];
    }

    ir::BufferId new_table(ir::NodeId id, const Variables& dimensions) {
        std::string name = name_ + "-by";
        for (ir::VariableId variable : dimensions) {
            const ir::Variable& dimension = program_[variable];
            name += "-" + (dimension.type ? program_.types[*dimension.type].name : dimension.name);
        }
        return builder_.tables().scratch(name, program_[id].type, builder_.properties(id).range,
                                         dimensions, span_);
    }

    // The node with elements of tables in it.
    ir::NodeId replaced(ir::NodeId id) {
        if (const auto element = elements_.find(id); element != elements_.end()) {
            return element->second;
        }
        if (const auto known = replaced_.find(id); known != replaced_.end()) return known->second;
        ir::Node node = program_[id];
        ir::change_operands(node, [&](ir::NodeId& operand) { operand = replaced(operand); });
        return replaced_[id] = builder_.rebuild(node);
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    std::string name_;  // of what is computed
    Span span_;
    std::set<ir::BufferId> filled_;  // by the current statement
    std::set<std::pair<ir::NodeId, Variables>> visited_;
    std::map<ir::NodeId, ir::NodeId> elements_;  // what stands for a node that became a table
    std::map<ir::NodeId, ir::NodeId> replaced_;
    std::map<std::uint32_t, ir::VariableId>
        objects_;  // by type, of tables that constants choose from
};

}  // namespace

ir::Program hoist_aggregations(ir::Program program, Report& report) {
    return Hoisting(std::move(program), report).run();
}

}  // namespace rddlc::passes
