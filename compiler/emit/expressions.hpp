// Expressions as C++ text on one line, with as few parentheses as a reader needs.
#pragma once

#include "emit/identifiers.hpp"
#include "emit/unit.hpp"
#include "ir/ir.hpp"
#include "ir/nest.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::cpp {

// How tightly a text holds together, loosest first.
enum class Level : std::uint8_t {
    Or,
    And,
    Comparison,
    Not,  // binds tighter in C++, but readers and compilers want (!a) == b
    Additive,
    Multiplicative,
    Unary,
    Primary,
};

struct Spelled {
    std::string text;
    Level level;
};

// The parameters that a function turns out to need.
struct Uses {
    bool state = false, action = false, scratch = false, next = false, observation = false;
    bool memory = false, next_memory = false;
    bool stores_state = false;
    bool stores_scratch = false, stores_next = false, stores_observation = false;
    bool stores_action = false, stores_next_memory = false;
    bool context = false;
};

// Spells the expressions of one function, by the names that are known at the current point.
class Expressions {
  public:
    explicit Expressions(const Unit& unit)
        : unit_(unit), scope_(&unit.names.file, function_words()) {}

    Spelled spell(ir::NodeId id);
    std::string text(ir::NodeId id) { return spell(id).text; }
    // Nothing if it has more characters than that: what does not fit is not spelled to its end.
    std::optional<std::string> text_within(ir::NodeId id, std::size_t most);
    // The alias of a type in the function: Bool, Int or Real.
    std::string type(ir::Scalar scalar);
    // An element to store into: next.x[i][j].
    std::string target(ir::BufferId buffer, const std::vector<ir::NodeId>& indices);
    // A statement that fills a table.
    std::string call_text(const ir::Call& call);
    // The call of an aggregation or of a draw over objects, up to its lambda.
    std::string call_head(const ir::Node& binder);
    // "[&](rddl::Index r)"; without the name where the body does not use it.
    std::string lambda_head(ir::VariableId variable, ir::NodeId body);
    // What a lambda returns: an int constant must not be C++'s int.
    std::string result(ir::NodeId id);
    std::optional<std::string> result_within(ir::NodeId id, std::size_t most);
    // One call of a draw from listed weights, given their array.
    bool needs_no_check(const ir::Sample& sample) const;
    std::string discrete_call(const ir::Discrete& discrete, const std::string& weights);

    // A named node is spelled by its name from then on.
    void name(ir::NodeId id, const std::string& name);
    void name(ir::LocalId local, const std::string& name) { locals_[local] = name; }
    bool is_named(ir::NodeId id) const { return named_.contains(id); }
    std::size_t named_count() const { return named_.size(); }
    std::string enter(ir::VariableId variable);
    // From here on loops run over several objects at once; the names of their context and of the
    // objects. Ended by `leave_nest`.
    struct SeveralObjects {
        ir::Nest nest;
        std::string context, objects;
    };
    const SeveralObjects& enter(ir::Nest nest);
    bool is_over_several() const { return several_.has_value(); }
    void leave_nest() { several_.reset(); }
    // What draws and branches take.
    std::string context() const { return several_ ? several_->context : "context"; }
    std::string claim(std::string_view wish) { return scope_.claim(wish); }

    // What was named since a mark is forgotten by returning to it.
    struct Mark {
        std::size_t scope, naming;
    };
    Mark mark() const { return {scope_.mark(), namings_.size()}; }
    void return_to(Mark mark);
    // The same, but the names stay taken.
    void forget(Mark mark);

    Uses& uses() { return uses_; }
    const Unit& unit() const { return unit_; }

  private:
    Spelled spell(const ir::Node& node, const ir::Constant& constant);
    Spelled spell(const ir::Node& node, const ir::Index& index);
    Spelled spell(const ir::Node& node, const ir::Load& load);
    Spelled spell(const ir::Node& node, const ir::Search& search);
    Spelled spell(const ir::Node& node, const ir::Bits& bits);
    Spelled spell(const ir::Node& node, const ir::Local& local);
    Spelled spell(const ir::Node& node, const ir::Convert& convert);
    Spelled spell(const ir::Node& node, const ir::Apply& apply);
    Spelled spell(const ir::Node& node, const ir::Select& select);
    Spelled spell(const ir::Node& node, const ir::Reduce& reduce);
    Spelled spell(const ir::Node& node, const ir::Sample& sample);
    Spelled spell(const ir::Node& node, const ir::Discrete& discrete);
    Spelled spell(const ir::Node& node, const ir::DiscreteOver& discrete);
    Spelled spell(const ir::Node& node, const ir::Fault& fault);

    std::string as_result(ir::NodeId id, const std::string& text);
    std::string call(const std::string& function, const std::vector<ir::NodeId>& operands,
                     const std::optional<ir::Place>& place = {});
    std::string lambda_call(const ir::Node& node, ir::VariableId variable, ir::NodeId body);
    // What an aggregation runs over: a count, a row of a table, or rddl::IndexRange(begin, end).
    std::string range(const ir::Reduce& reduce);
    std::optional<std::string> row_of(const ir::Bounds& bounds);
    std::optional<std::string> element_of_row(const ir::Load& load);
    std::string arguments(const std::vector<ir::NodeId>& operands);
    std::string place(const ir::Place& place);
    std::string record(ir::BufferId buffer);
    std::string view(const ir::TableView& view, bool is_written);
    std::string external_call_text(const ir::Call& call);
    Spelled index(ir::NodeId id);
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
    std::optional<SeveralObjects> several_;
    Uses uses_;
    static constexpr std::size_t all_nodes = std::numeric_limits<std::size_t>::max();
    std::size_t nodes_left_ = all_nodes;  // that may be spelled
};

}  // namespace rddlc::cpp
