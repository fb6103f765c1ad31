// Finds the object that fulfils a condition, if at most one can.
#pragma once

#include "ir/builder.hpp"
#include "ir/ir.hpp"
#include "passes/analyses/decisive.hpp"

#include <optional>

namespace rddlc::passes {

struct OnlyObject {
    ir::NodeId index;   // Int, in range in any case
    ir::NodeId exists;  // Bool: whether it fulfils the condition; if not, none does
};

class OnlyObjects {
  public:
    // May add tables to the program, which is the builder's. Both must outlive this.
    OnlyObjects(ir::Program& program, ir::Builder& builder)
        : program_(program), builder_(builder) {}

    // The one of the objects that the variable runs over. Neither part depends on the variable,
    // draws again or may fault. Nothing if several objects may fulfil the condition.
    std::optional<OnlyObject> fulfilling(const Condition& condition, ir::VariableId variable);

  private:
    // A constant table, as seen from one of its axes.
    struct Column {
        ir::BufferId table;
        std::size_t axis;
        std::vector<ir::NodeId> indices;  // of all axes; that of `axis` does not count
    };
    std::optional<Column> column(ir::NodeId id, ir::VariableId variable) const;

    std::optional<OnlyObject> equal_to(ir::NodeId side, ir::NodeId other, ir::VariableId variable);
    std::optional<OnlyObject> with_value(const Column& column, ir::NodeId value);
    std::optional<OnlyObject> with_entry(const Column& column, bool entry);
    ir::NodeId load(const ir::Buffer& like, const std::string& suffix, ir::Scalar scalar,
                    Table values, const Column& column);

    bool depends_on(ir::NodeId id, ir::VariableId variable) const;
    bool is_within(ir::NodeId id, std::int64_t first, std::int64_t last) const;
    ir::NodeId test(ir::NodeId id, std::int64_t first, std::int64_t last);
    ir::NodeId clamped(ir::NodeId id, std::int64_t first, std::int64_t last);
    ir::NodeId number(std::int64_t value) { return builder_.constant(value); }

    ir::Program& program_;
    ir::Builder& builder_;
};

}  // namespace rddlc::passes
