// The only way to make nodes: folds what is known, and gives equal expressions equal ids.
//
// Folding is exact: the value of every expression stays the same bit for bit, computed with the
// runtime's own functions, and what draws or may fault never disappears. The right operand of
// And, Or and Implies, where it may fault, becomes lazy (a Select): so C++ may spell them && and
// ||.
#pragma once

#include "ir/analysis.hpp"
#include "ir/ir.hpp"
#include "ir/new_tables.hpp"

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace rddlc::ir {

class Builder {
  public:
    // Adds to the program's pool and tables. While a builder lives, only it may add nodes.
    explicit Builder(Program& program);

    const Program& program() const { return program_; }
    const Properties& properties(NodeId id) const { return properties_[id.index]; }
    NewTables& tables() { return new_tables_; }

    // All nans are one.
    NodeId constant(Value value);
    // 0 for a variable over one object.
    NodeId index(VariableId variable);
    NodeId load(BufferId buffer, std::vector<NodeId> indices, Gather gather = Gather::None);
    NodeId search(BufferId table, NodeId value);
    // `buffer` is not a Constant.
    NodeId bits(BufferId buffer, std::int64_t first, std::vector<NodeId> indices = {});
    NodeId united(BufferId masks, std::vector<NodeId> row, NodeId bits);
    // `buffer` is not a Constant.
    NodeId element(BufferId buffer, NodeId place, std::vector<NodeId> indices = {});
    NodeId local(LocalId local, Scalar type);
    NodeId convert(NodeId operand, Scalar type, bool skips_int = false);
    // `place` for exactly the operators that may fault (vocabulary/vocabulary.hpp).
    NodeId apply(Operator op, std::vector<NodeId> operands, std::optional<Place> place = {});
    NodeId select(NodeId condition, NodeId then_value, NodeId else_value,
                  Evaluated evaluated = Evaluated::Branch);
    // Over an empty variable only for reductions that have a value there.
    NodeId reduce(Reduction op, VariableId variable, NodeId body, std::optional<Bounds> bounds = {},
                  bool over_true = false, bool several_at_once = false);
    // An aggregation whose terms are combined already, such as one over a single object: a sum of
    // reals begins with 0.0, and so is never -0.0.
    NodeId aggregated(Reduction op, NodeId terms);
    NodeId sample(Scalar type, Distribution distribution, Place place,
                  std::vector<NodeId> parameters, bool is_valid = false);
    NodeId discrete(bool normalise, Place place, std::vector<NodeId> weights);
    NodeId discrete_over(bool normalise, Place place, VariableId variable, NodeId weight);
    NodeId interval(Place place, BufferId table, std::vector<NodeId> row);
    NodeId fault(Scalar type, Place place);

    // The same form with other operands, folded again. Ids inside `node` are this program's.
    NodeId rebuild(const Node& node);

  private:
    NodeId intern(Node node);

    Program& program_;
    std::vector<Properties> properties_;  // by NodeId::index
    TableProperties table_properties_;
    NewTables new_tables_;
    struct HashOfWords {
        std::size_t operator()(const std::vector<std::uint64_t>& words) const;
    };
    std::unordered_map<std::vector<std::uint64_t>, NodeId, HashOfWords> known_;
};

}  // namespace rddlc::ir
