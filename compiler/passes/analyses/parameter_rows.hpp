// The values of a draw's parameters that the instance, the objects of loops and a few small ints
// decide: a row for each combination.
#pragma once

#include "ir/builder.hpp"
#include "ir/evaluator.hpp"
#include "ir/ir.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <vector>

namespace rddlc::passes {

// An int of a small range, or a bool, that parameters depend on.
struct ParameterKey {
    ir::NodeId id;
    std::int64_t least;
    std::int64_t count;
};

// Rows by the objects of loops and the values of keys, row-major.
struct ParameterRows {
    std::set<ir::VariableId> variables;  // of the loops around
    std::vector<ParameterKey> ints;
    std::vector<std::vector<double>> values;  // by row, then by parameter
};

class ParameterTabulation {
  public:
    ParameterTabulation(ir::Program& program, ir::Builder& builder)
        : program_(program), builder_(builder), evaluator_(program) {}

    using Result = std::optional<ir::NodeId>;
    using Use = std::function<Result(const ParameterRows&)>;

    // The result of `use` on the rows; nothing if the parameters depend on more, or if these have
    // too many combinations for tables of so many elements a row.
    Result tabulated(const std::vector<ir::NodeId>& parameters, std::size_t elements_of_row,
                     const Use& use);

  private:
    // The parts of an int or a bool that is made of others: itself, or those.
    enum class Kind { Outermost, Innermost };
    // By parameter, then by object.
    using OfObjects = std::vector<std::vector<ir::Value>>;

    std::optional<ParameterRows> keys_of(const std::vector<ir::NodeId>& parameters,
                                         std::size_t elements_of_row, Kind kind);
    bool find_keys(ir::NodeId id, Kind kind, ParameterRows& keys) const;
    bool find_keys_below(ir::NodeId id, Kind kind, ParameterRows& keys) const;
    bool is_within_constant_table(const ir::Load& load) const;
    std::optional<ParameterKey> key_of(ir::NodeId id) const;
    ir::NodeId value_of(const ParameterKey& key, std::int64_t value);
    bool add_values(const std::vector<ir::NodeId>& parameters, ParameterRows& keys);
    std::optional<OfObjects> values_of(const std::vector<ir::NodeId>& parameters,
                                       const ParameterRows& keys, std::int64_t combination);

    ir::Program& program_;
    ir::Builder& builder_;
    ir::Evaluator evaluator_;
    double left_ = 1 << 18;  // elements of all tables
};

}  // namespace rddlc::passes
