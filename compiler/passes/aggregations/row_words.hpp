// Bools of the objects of one variable as the bits of an int, which are 0 beyond the last object.
#pragma once

#include "ir/builder.hpp"
#include "ir/ir.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace rddlc::passes {

inline constexpr std::int64_t bits_of_an_int = 64;
// An int of which so many bits are 1, from the lowest on; at least one is.
constexpr std::int64_t first_bits(std::int64_t count) {
    return static_cast<std::int64_t>(~std::uint64_t{0} >> (bits_of_an_int - count));
}

// The leading indices of an element, if the row that they choose is the same one in all
// environments and no constant, so that ir::Bits may read it.
std::optional<std::vector<ir::NodeId>> uniform_row_of(const ir::Builder& builder,
                                                      const ir::Load& element);

class RowWords {
  public:
    // The word of a bool of each object that is no row of a table; nothing if it has none.
    using WordOfOther = std::function<std::optional<ir::NodeId>(ir::NodeId)>;

    // For at most bits_of_an_int objects. The builder must outlive this.
    RowWords(ir::Builder& builder, ir::VariableId object, WordOfOther word_of_other);

    std::optional<ir::NodeId> word_of(ir::NodeId id);

    ir::NodeId none();
    ir::NodeId all();
    ir::NodeId inverted(ir::NodeId word);
    ir::NodeId either(ir::NodeId a, ir::NodeId b);
    ir::NodeId both(ir::NodeId a, ir::NodeId b);
    bool depends_on_object(ir::NodeId id) const;
    std::int64_t size() const;

  private:
    std::optional<ir::NodeId> known_word(ir::NodeId id);
    std::optional<ir::NodeId> bits_of(const ir::Load& load);
    std::optional<ir::NodeId> word_of(const ir::Select& select);
    std::optional<ir::NodeId> word_of(const ir::Apply& apply);

    ir::Builder& builder_;
    ir::VariableId object_;
    WordOfOther word_of_other_;
};

}  // namespace rddlc::passes
