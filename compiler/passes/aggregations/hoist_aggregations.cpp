#include "passes/aggregations/hoist_aggregations.hpp"

#include "ir/call.hpp"
#include "ir/cost_model.hpp"
#include "ir/fill_table.hpp"
#include "ir/rewrite.hpp"
#include "ir/split_quantifier.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <span>
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
        if (is_worthwhile(id, around, loops)) return make_table(id, around, loops, before);
        if (is_chosen_by_table(id, around, loops, before)) return;
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

    // Makes a table of an aggregation that a constant table chooses, or of the part of an exists or
    // forall that its variable changes.
    bool is_chosen_by_table(ir::NodeId id, const Variables& around, std::size_t loops,
                            ir::Block& before) {
        const auto* found = std::get_if<ir::Reduce>(&program_[id].form);
        if (!found || builder_.properties(id).may_fault) return false;
        const auto split = ir::split_quantifier(builder_, ir::Reduce(*found));
        const ir::NodeId rest = split ? builder_.rebuild({ir::Scalar::Bool, split->rest}) : id;
        if (!elements_.contains(rest)) {
            const auto chosen = chosen_by_table(rest, around, loops);
            if (!chosen) return false;
            make_table(*chosen, before);
        }
        if (rest != id) elements_[id] = with_fixed(*split, elements_.at(rest));
        return true;
    }
    // An aggregation that objects decide only through an element of a constant table, f(OWNER[t]):
    // what that is of the objects that the element chooses, and of the other variables around it.
    struct Chosen {
        ir::NodeId aggregation;
        ir::NodeId element;
        Variables dimensions;  // the object that the element chooses is the last
        ir::NodeId value;
    };
    std::optional<Chosen> chosen_by_table(ir::NodeId id, const Variables& around,
                                          std::size_t loops) {
        const ir::Properties properties = builder_.properties(id);
        if (!may_choose(id, around.size() > loops) || properties.uniform ||
            !ir::is_droppable(properties) || !ir::is_known_before(program_, id, filled_))
            return std::nullopt;
        const auto element = element_by_table(id, properties.free_variables);
        if (!element) return std::nullopt;
        const auto [place, type] = *element;
        const ir::VariableId object = object_of(type);
        std::map<ir::NodeId, ir::NodeId> known = {{place, builder_.index(object)}};
        const ir::NodeId value = ir::replace_in(builder_, id, known);
        Variables dimensions = needed_by(value, around);
        if (ir::depends_on_any(builder_.properties(place), dimensions)) return std::nullopt;
        dimensions.push_back(object);
        if (!is_worth_a_table(properties.cost, product_of_sizes(dimensions), around,
                              worthwhile_by_table))
            return std::nullopt;
        return Chosen{id, place, std::move(dimensions), value};
    }
    // A long sum of one object; and an exists or forall that another aggregation repeats. Loops
    // alone read bools by their places (read_places).
    bool may_choose(ir::NodeId id, bool is_repeated) const {
        const auto* reduce = std::get_if<ir::Reduce>(&program_[id].form);
        if (!reduce) return false;
        const ir::Properties& properties = builder_.properties(id);
        if (reduce->op == Reduction::Sum)
            return properties.cost >= worth_choosing && properties.free_variables.size() == 1;
        return program_[id].type == ir::Scalar::Bool && is_repeated &&
               properties.cost >= worth_hoisting;
    }
    // The first index that is an element of a constant table at some of the variables, and of which
    // type the objects are that it chooses.
    std::optional<std::pair<ir::NodeId, std::uint32_t>> element_by_table(
        ir::NodeId id, const Variables& variables) const {
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        for (std::size_t k = 0; load && k < program_[load->buffer].types.size(); ++k)
            if (is_of_table(load->indices[k], variables))
                return std::pair{load->indices[k], program_[load->buffer].types[k]};
        for (const ir::NodeId operand : ir::operands_of(program_[id]))
            if (const auto found = element_by_table(operand, variables)) return found;
        return std::nullopt;
    }
    bool is_of_table(ir::NodeId id, const Variables& variables) const {
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        return load && program_[load->buffer].storage == ir::Storage::Constant &&
               !load->indices.empty() && std::ranges::all_of(load->indices, [&](ir::NodeId index) {
                   const auto* variable = std::get_if<ir::Index>(&program_[index].form);
                   return variable && contains(variables, variable->variable);
               });
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

    void make_table(ir::NodeId id, const Variables& around, std::size_t loops, ir::Block& before) {
        const Variables dimensions = in_rows(id, needed_by(id, around), around, loops);
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
    void make_table(const Chosen& chosen, ir::Block& before) {
        const ir::BufferId table = new_table(chosen.aggregation, chosen.dimensions);
        const ir::NodeId own =
            ir::fill_table(builder_, before, table, chosen.dimensions, chosen.value);
        std::map<ir::NodeId, ir::NodeId> known = {
            {builder_.index(chosen.dimensions.back()), chosen.element}};
        elements_[chosen.aggregation] = ir::replace_in(builder_, own, known);
        replaced_.clear();
        ++report_["tables filled before loops"];
    }

    // The variables of the expression, outermost first.
    Variables needed_by(ir::NodeId id, const Variables& around) const {
        Variables needed;
        std::ranges::copy_if(around, std::back_inserter(needed), [&](ir::VariableId variable) {
            return contains(builder_.properties(id).free_variables, variable);
        });
        return needed;
    }
    // Bools of the objects of a loop lie in rows, one for the objects of each aggregation, so that
    // registers read them.
    Variables in_rows(ir::NodeId id, Variables dimensions, const Variables& around,
                      std::size_t loops) const {
        const std::span<const ir::VariableId> all_loops = std::span(around).first(loops);
        // The algorithm of std::ranges does not compile with clang++ 14.
        if (program_[id].type == ir::Scalar::Bool)
            std::stable_partition(
                dimensions.begin(), dimensions.end(), [&](ir::VariableId variable) {
                    return std::ranges::find(all_loops, variable) == all_loops.end();
                });
        return dimensions;
    }
    static bool contains(const Variables& variables, ir::VariableId variable) {
        return std::ranges::find(variables, variable) != variables.end();
    }

    ir::NodeId with_fixed(const ir::SplitQuantifier& split, ir::NodeId rest) {
        std::vector<ir::NodeId> parts = split.fixed;
        parts.push_back(rest);
        return ir::joined(builder_, split.op, parts);
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
