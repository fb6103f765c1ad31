// Whether expressions can be evaluated for several objects at once (rddl/object_lanes/objects.hpp):
// they need elements of their own objects, what is the same for all, or what they choose from
// constants. So do the terms of their aggregations, in which an object's elements have to lie
// beside those of its neighbours.
#pragma once

#include "ir/analysis.hpp"
#include "ir/builder.hpp"
#include "ir/ir.hpp"
#include "ir/nest.hpp"

#include <functional>
#include <vector>

namespace rddlc::passes {

// For the objects of a nest of loops, or of aggregations, over these variables.
class ObjectLanes {
  public:
    using PropertiesOf = std::function<const ir::Properties&(ir::NodeId)>;

    // `is_element` says which nodes will become elements of tables.
    ObjectLanes(const ir::Program& program, PropertiesOf properties_of, ir::Nest nest,
                std::function<bool(ir::NodeId)> is_element = nullptr);
    // The program is being built, so properties are asked of the builder.
    ObjectLanes(const ir::Builder& builder, ir::Nest nest,
                std::function<bool(ir::NodeId)> is_element = nullptr);

    // Too few iterations, which give such values, do not fill the registers.
    bool are_enough(ir::Scalar scalar) const;
    bool can_evaluate(ir::NodeId id) const;
    // Into elements of these objects, in a table of theirs or in a row that is the same for all.
    bool can_store(const ir::Store& store) const;
    bool can_store_in_row(const ir::Store& store) const;

  private:
    bool can_index(ir::BufferId buffer, const std::vector<ir::NodeId>& indices) const;
    bool can_gather(ir::BufferId buffer, const std::vector<ir::NodeId>& indices) const;
    bool can_aggregate(const ir::Reduce& reduce) const;
    bool adds_own_row(const ir::Reduce& reduce) const;
    bool can_be_term(ir::NodeId id) const;
    bool can_be_weight(ir::NodeId id) const;
    bool is_same(ir::NodeId id) const;
    bool is_at_own_place(const ir::Element& element) const;
    bool can_evaluate_all(const std::vector<ir::NodeId>& ids) const;

    const ir::Program& program_;
    PropertiesOf properties_of_;
    ir::Nest nest_;
    std::function<bool(ir::NodeId)> is_element_;
    bool reads_rows_ = true;  // of tables of constants
};

}  // namespace rddlc::passes
