#include "ir/narrow_bits.hpp"

#include <rddl/values/narrow_width.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <variant>

namespace rddlc::ir {
namespace {

// Bits of a lane, as rddl::narrow_width has them.
constexpr int no_width = 0;
constexpr int least_width = rddl::narrow_width(1);

class NarrowBits {
  public:
    NarrowBits(const Program& program, const std::vector<Properties>& properties)
        : program_(program),
          properties_(properties),
          widths_(program.nodes.size(), no_width),
          roots_(roots_of(program)) {
        for (const Block* block : blocks_of(program)) add_lets(*block);
    }

    std::vector<bool> find() && {
        for (std::uint32_t k = 0; k < program_.nodes.size(); ++k)
            widths_[k] = width_by_operands(NodeId{k});
        for (const NodeId root : roots_) widths_[root.index] = no_width;
        // A node that is not narrow leaves what it joins, and what joins it, wide.
        for (bool has_changed = true; has_changed;) has_changed = narrow_down();
        std::vector<bool> result;
        for (const int width : widths_) result.push_back(width != no_width);
        return result;
    }

  private:
    // A Let may have a narrow value, other statements not.
    void add_lets(const Block& block) {
        for_each_statement<Let>(block, [&](const Let& let) {
            values_.emplace(let.local, let.value);
            if (const auto root = std::ranges::find(roots_, let.value); root != roots_.end())
                roots_.erase(root);
        });
    }
    // A name stands for the value that has it.
    NodeId named(NodeId id) const {
        const auto* local = std::get_if<Local>(&program_[id].form);
        const auto value = local ? values_.find(local->local) : values_.end();
        return value == values_.end() ? id : value->second;
    }

    // Operands stand before the nodes that use them, and values before their names.
    int width_by_operands(NodeId id) const {
        if (named(id) != id) return widths_[named(id).index];
        const Node& node = program_[id];
        if (const auto* bits = std::get_if<Bits>(&node.form)) {
            const std::int64_t count = program_[bits->buffer].row_size(bits->indices.size());
            return bits->first == 0 ? rddl::narrow_width(count) : no_width;
        }
        const auto* apply = std::get_if<Apply>(&node.form);
        if (!apply || !is_one_of(apply->op, {Operator::BitAnd, Operator::BitOr, Operator::BitXor}))
            return no_width;
        return common_width(*apply);
    }
    // The width of the operands that are narrow, if the others are ints that fit.
    int common_width(const Apply& apply) const {
        int width = no_width;
        for (const NodeId operand : apply.operands) {
            const int own = widths_[operand.index];
            if (own == no_width) continue;
            if (width != no_width && own != width) return no_width;
            width = own;
        }
        const bool fit = std::ranges::all_of(apply.operands, [&](NodeId operand) {
            return widths_[operand.index] != no_width || fits(operand, width);
        });
        return fit ? width : no_width;
    }
    bool fits(NodeId id, int width) const {
        const Properties& properties = properties_[id.index];
        const auto limit = static_cast<double>(std::int64_t{1} << width);
        return properties.uniform && properties.range && properties.range->lower >= -limit &&
               properties.range->upper < limit;
    }

    bool narrow_down() {
        bool has_changed = false;
        const auto widen = [&](NodeId id) {
            has_changed |= widths_[id.index] != no_width;
            widths_[id.index] = no_width;
        };
        for (std::uint32_t k = 0; k < program_.nodes.size(); ++k) {
            const Node& node = program_.nodes[k];
            if (widths_[k] != no_width && width_by_operands(NodeId{k}) != widths_[k])
                widen(NodeId{k});
            if (widths_[k] != no_width) continue;
            if (named(NodeId{k}) != NodeId{k}) widen(named(NodeId{k}));
            if (!takes_narrow(node))
                for (const NodeId operand : operands_of(node)) widen(operand);
        }
        return has_changed;
    }
    // For a node that is not narrow itself. Counts are of wide lanes, so bits that are all counted,
    // and more than 15 bits of which some are, gain nothing.
    bool takes_narrow(const Node& node) const {
        const auto* apply = std::get_if<Apply>(&node.form);
        if (!apply) return false;
        const int width = widths_[apply->operands.front().index];
        if (apply->op == Operator::CountOnes)
            return width == least_width &&
                   !std::holds_alternative<Bits>(program_[named(apply->operands.front())].form);
        if (!is_one_of(apply->op, {Operator::Equal, Operator::NotEqual})) return false;
        return width != no_width && fits(apply->operands.back(), width);
    }

    const Program& program_;
    const std::vector<Properties>& properties_;
    std::vector<int> widths_;           // rddl::narrow_width, by NodeId
    std::vector<NodeId> roots_;         // but the values of Lets
    std::map<LocalId, NodeId> values_;  // of Lets
};

}  // namespace

std::vector<bool> narrow_bits(const Program& program, const std::vector<Properties>& properties) {
    return NarrowBits(program, properties).find();
}

}  // namespace rddlc::ir
