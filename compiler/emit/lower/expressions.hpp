// Expressions of the IR as those of C++.
#pragma once

#include "emit/cpp/tree.hpp"
#include "emit/lower/unit.hpp"
#include "emit/names/identifiers.hpp"
#include "ir/ir.hpp"
#include "ir/nest.hpp"
#include "ir/reduction_nest.hpp"
#include "ir/shares.hpp"

#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rddlc::cpp {

// The things that a function needs, found while it is lowered.
struct Uses {
    std::set<ir::Storage> records;  // its parameters
    std::set<ir::Storage> stored;   // those that it changes
    std::set<ir::Scalar> types;
    bool context = false;
    bool numbers = false;  // of the step
    bool normals = false;  // of the step

    void add(const Uses& others);
    bool has(ir::Storage storage) const { return records.contains(storage); }
};

// Lowers the expressions of one function, by the names that are known at the current point.
class Expressions {
  public:
    explicit Expressions(const Unit& unit)
        : unit_(unit), scope_(&unit.names.file, function_words()) {}

    tree::Expression lower(ir::NodeId id);
    // How many characters it has on one line; one more than `most` if it has more than that: what
    // is longer is not lowered to its end.
    std::size_t width_within(ir::NodeId id, std::size_t most);
    // The result of `make` is only inspected: it does not count as a use.
    template <class Make>
    auto measured(Make&& make) {
        Uses before = std::exchange(uses_, {});
        auto made = make();
        uses_ = std::move(before);
        return made;
    }
    // The alias of a type in the function: Bool, Int or Real.
    std::string type(ir::Scalar scalar);
    // An element to store into: next.x[i][j].
    tree::Expression target(ir::BufferId buffer, const std::vector<ir::NodeId>& indices);
    // A statement that fills a table.
    tree::Statement lower(const ir::Call& call);
    // An aggregation or a draw over objects; `body` is called while its variable has a name.
    template <class Body>
    tree::Expression lower_binder(const ir::Node& binder, Body&& body) {
        if (auto sum = sum_of_row(binder)) return *std::move(sum);
        if (auto count = count_of_true(binder)) return *std::move(count);
        if (auto any = any_in_common_rows(binder)) return *std::move(any);
        if (auto sum = sum_where_true(binder)) return *std::move(sum);
        if (auto draw = draw_of_row(binder)) return *std::move(draw);
        if (const auto nest = several_at_once(binder)) {
            const Mark before = mark();
            const ObjectNames names = enter({nest->variables, nullptr});
            uses_.context = false;  // whether the test uses its own
            tree::Block test = body(nest->body);
            leave_nest();
            return_to(before);
            return quantifier_of_objects(*nest, names, std::move(test));
        }
        const auto shares = shares_of(binder);
        tree::Expressions arguments = binder_arguments(binder);
        if (shares) arguments.push_back(lower(shares->total));
        const Mark before = mark();
        const ir::VariableId variable = *ir::bound_variable(binder);
        enter(variable);
        const ir::Reduce* const second = second_over_true(binder);
        if (second) enter(second->variable);
        const ir::NodeId value = shares ? shares->weights.front() : bound_value(binder);
        tree::Expressions parameters = {parameter(variable, value)};
        if (second) parameters.push_back(parameter(second->variable, value));
        arguments.push_back({tree::Lambda{std::move(parameters), body(value)}});
        return_to(before);
        return tree::call(
            shares ? "rddl::sample::discrete_of_shares_over" : binder_function(binder),
            std::move(arguments));
    }
    // The return type of a lambda: an int constant must not become C++'s int.
    tree::Expression result(ir::NodeId id);
    // The weights of a draw that lists them, or those that it divides by their total.
    struct ListedWeights {
        std::vector<ir::NodeId> weights;
        std::optional<ir::NodeId> total;
    };
    ListedWeights listed_weights(const ir::Node& draw) const;
    // One call of such a draw, given the array of its weights.
    tree::Expression discrete_call(const ir::Discrete& discrete, const ListedWeights& listed,
                                   tree::Expression weights);
    std::string weights_type(const ir::Discrete& discrete);

    // A named node is lowered to its name from then on.
    void name(ir::NodeId id, const std::string& name);
    void name(ir::LocalId local, const std::string& name) { locals_[local] = name; }
    bool is_named(ir::NodeId id) const { return named_.contains(id); }
    std::size_t named_count() const { return named_.size(); }
    std::string enter(ir::VariableId variable);
    // From here on loops run over several objects at once; the names of their context and of the
    // objects. Ended by `leave_nest`.
    struct ObjectNames {
        std::string context, objects;
    };
    ObjectNames enter(ir::Nest nest);
    bool is_over_several() const { return several_.has_value(); }
    // Whether what has been lowered since then looks at few bits, of each object its own.
    bool looks_at_few_bits() const { return several_->looks_at_few_bits; }
    void leave_nest() { several_.reset(); }
    // "auto& several"; without the name where the body does not use it.
    static tree::Expression context_parameter(bool is_used, const std::string& name);
    // The number of combinations of the variables: "link_count * link_count".
    std::string count_of(std::span<const ir::VariableId> variables) const;
    // The arguments of draws and branches.
    std::string context() const { return several_ ? several_->context : "context"; }
    std::string claim(std::string_view wish) { return scope_.claim(wish); }

    // Returning to a mark forgets all names since that mark.
    struct Mark {
        std::size_t scope, naming;
    };
    Mark mark() const { return {scope_.mark(), namings_.size()}; }
    void return_to(Mark mark);
    // The same, but the names stay taken.
    void forget(Mark mark);

    // A table whole: its name, or the member of the record that holds it.
    tree::Expression record(ir::BufferId buffer);
    // The sliding buffer of a table of the state or the next one; and both, whether or not the
    // table lies there.
    tree::Expression sliding_buffer(ir::BufferId buffer);
    tree::Expressions with_sliding_buffer(ir::BufferId buffer);
    // The sum of each object's row of a table; nothing if a node is something else.
    std::optional<tree::Expression> sum_of_row(const ir::Node& node);

    Uses& uses() { return uses_; }
    const Unit& unit() const { return unit_; }

  private:
    tree::Expression lower(const ir::Node& node, const ir::Constant& constant);
    tree::Expression lower(const ir::Node& node, const ir::Index& index);
    tree::Expression lower(const ir::Node& node, const ir::Load& load);
    tree::Expression lower(const ir::Node& node, const ir::Search& search);
    tree::Expression lower(const ir::Node& node, const ir::Bits& bits);
    tree::Expression bits_of(const ir::Bits& bits, std::string_view kind);
    tree::Expression lower(const ir::Node& node, const ir::Union& form);
    tree::Expression lower(const ir::Node& node, const ir::Element& element);
    tree::Expression lower(const ir::Node& node, const ir::Local& local);
    tree::Expression lower(const ir::Node& node, const ir::Convert& convert);
    tree::Expression lower(const ir::Node& node, const ir::Apply& apply);
    tree::Expression lower(const ir::Node& node, const ir::Select& select);
    tree::Expression lower(const ir::Node& node, const ir::Reduce& reduce);
    tree::Expression lower(const ir::Node& node, const ir::Sample& sample);
    tree::Expression lower(const ir::Node& node, const ir::Discrete& discrete);
    tree::Expression lower(const ir::Node& node, const ir::DiscreteOver& discrete);
    tree::Expression lower(const ir::Node& node, const ir::Interval& interval);
    tree::Expression lower(const ir::Node& node, const ir::Fault& fault);

    std::optional<tree::Expression> test_of_few_bits(const ir::Apply& apply);
    std::optional<tree::Expression> of_few_bits(const std::string& function, ir::NodeId joined);
    tree::Expression inline_binder(const ir::Node& node);
    tree::Expression call(std::string_view function, const std::vector<ir::NodeId>& operands,
                          const std::optional<ir::Place>& place = {});
    std::optional<ir::Shares> shares_of(const ir::Node& draw) const;
    std::string binder_function(const ir::Node& binder);
    // The sum, if it visits true elements alone.
    const ir::Reduce* over_true(const ir::Node& binder) const;
    // The sum inside it, if these are the elements of a table.
    const ir::Reduce* second_over_true(const ir::Node& binder) const;
    // The choice between what is added where an element is true, and zero.
    const ir::Select& term_over_true(const ir::Node& binder) const;
    std::optional<tree::Expression> sum_where_true(const ir::Node& binder);
    std::optional<tree::Expression> draw_of_row(const ir::Node& binder);
    std::optional<tree::Expression> count_of_true(const ir::Node& binder);
    std::optional<tree::Expression> any_in_common_rows(const ir::Node& binder);
    // The term of an aggregation, or the weight of a draw.
    ir::NodeId bound_value(const ir::Node& binder) const;
    // The row or table of which such a sum visits the true elements.
    tree::Expression bools_of(const ir::Reduce& reduce);
    // The exists or forall, if it tests several objects at once.
    std::optional<ir::ReductionNest> several_at_once(const ir::Node& binder) const;
    tree::Expression quantifier_of_objects(const ir::ReductionNest& nest, const ObjectNames& names,
                                           tree::Block test);
    tree::Expressions binder_arguments(const ir::Node& binder);
    // "rddl::Index r"; without the name where the body does not use it.
    tree::Expression parameter(ir::VariableId variable, ir::NodeId body) const;
    // The range of an aggregation: a count, a row of a table, or rddl::IndexRange(begin, end).
    tree::Expression range(const ir::Reduce& reduce);
    tree::Expression of_objects(const std::string& function, tree::Expression table,
                                std::span<const ir::NodeId> indices);
    tree::Expression element_of(const ir::Load& load);
    tree::Expression element_of_row(const ir::Load& load);
    tree::Expression tested(ir::BufferId buffer, tree::Expression element) const;
    tree::Expressions all_of(std::span<const ir::NodeId> operands);
    // The context and the place of a draw or a fault.
    tree::Expressions place(const ir::Place& place, const std::string& type = "");
    // Its site and index, and its series if that is another's.
    tree::Expressions numbers_of(const ir::Place& place);
    // "rddl::LonePlace" for a draw that a step makes once, "rddl::PlaceAmongSites" for one of many.
    // No distribution: one of weights or thresholds.
    tree::Expressions place_of_draw(const ir::Place& place,
                                    std::optional<Distribution> distribution = {});
    // "rddl::place_in_row<0>(numbers, 1, g)": its number is made before the step.
    tree::Expression place_in_step(const ir::Place& place, const StepDraws::Where& where);
    // "rddl::place_of_normals<0>(normals, place)": its normals are made before the step.
    tree::Expression place_of_normals(std::size_t loop, tree::Expression place);
    // The objects of the place's scope, if it is in a loop over them.
    std::optional<ir::Variable> objects_among(const ir::Place& place) const;
    tree::Expression elements(tree::Expression table, std::span<const ir::NodeId> indices);
    tree::Expression view(const ir::TableView& view, bool is_written);
    tree::Statement external_call(const ir::Call& call);
    tree::Statement together(const ir::Call& call);
    tree::Expression index(ir::NodeId id);
    bool is_plain_index(ir::NodeId id) const;

    const Unit& unit_;
    Scope scope_;
    std::map<ir::NodeId, std::string> named_;
    struct Naming {
        ir::NodeId id;
        std::optional<std::string> before;  // its name until then
    };
    std::vector<Naming> namings_;  // to be undone, since copies of all names would be too many
    std::map<ir::VariableId, std::string> variables_;
    std::map<ir::LocalId, std::string> locals_;
    struct ObjectLanes {
        ir::Nest nest;
        std::string context, objects;
        bool looks_at_few_bits = false;
    };
    std::optional<ObjectLanes> several_;
    Uses uses_;
    static constexpr std::size_t all_nodes = std::numeric_limits<std::size_t>::max();
    std::size_t nodes_left_ = all_nodes;  // that may be lowered
};

}  // namespace rddlc::cpp
