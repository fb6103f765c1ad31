#include "passes/analyses/plain_definition.hpp"

#include <algorithm>

namespace rddlc::passes {
namespace {

// The innermost block, if all around it are loops with nothing else inside; with their variables.
const ir::Block* innermost(const ir::Block& body, std::vector<ir::VariableId>& loops) {
    const ir::Block* block = &body;
    while (block->size() == 1) {
        const auto* loop = std::get_if<ir::Loop>(&block->front().form);
        if (!loop) return block;
        loops.push_back(loop->variable);
        block = &loop->body;
    }
    return nullptr;
}

}  // namespace

std::optional<PlainDefinition> plain_definition(const ir::Program& program,
                                                const ir::Definition& definition) {
    std::vector<ir::VariableId> loops;
    const ir::Block* block = innermost(definition.body, loops);
    const ir::Store* store = block ? std::get_if<ir::Store>(&block->front().form) : nullptr;
    if (!store) return std::nullopt;

    PlainDefinition plain{.variables = {}, .value = store->value};
    for (std::size_t axis = 0; axis < store->indices.size(); ++axis) {
        const auto* index = std::get_if<ir::Index>(&program[store->indices[axis]].form);
        if (!index && program[store->target].shape[axis] != 1) return std::nullopt;
        plain.variables.push_back(index ? std::optional(index->variable) : std::nullopt);
        if (index && std::erase(loops, index->variable) != 1) return std::nullopt;
    }
    if (!loops.empty()) return std::nullopt;
    return plain;
}

}  // namespace rddlc::passes
