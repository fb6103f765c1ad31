#include "ir/fill_table.hpp"

#include "ir/nest.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace rddlc::ir {

NodeId fill_table(Builder& builder, Block& block, BufferId table,
                  const std::vector<VariableId>& variables, NodeId value) {
    std::vector<NodeId> indices;
    for (const VariableId variable : variables) indices.push_back(builder.index(variable));
    Block store;
    store.push_back({Store{table, indices, value}});
    std::ranges::move(looped(std::move(store), variables), std::back_inserter(block));
    return builder.load(table, std::move(indices));
}

}  // namespace rddlc::ir
