#include "ir/few_bits.hpp"

#include <bit>
#include <cstdint>
#include <variant>

namespace rddlc::ir {
namespace {

constexpr int most_ones = 4;

bool is_of_few_ones(const Buffer& buffer) {
    return buffer.storage == Storage::Constant && buffer.values.all_of([](const Value& value) {
        return std::popcount(static_cast<std::uint64_t>(std::get<std::int64_t>(value))) <=
               most_ones;
    });
}

}  // namespace

std::optional<FewBits> few_bits(const Program& program, const std::vector<bool>& narrow_bits,
                                NodeId joined) {
    const auto* both = std::get_if<Apply>(&program[joined].form);
    if (!both || both->op != Operator::BitAnd || !narrow_bits[joined.index]) return std::nullopt;
    const auto is_chosen_alike = [&](const Load& load) {
        return load.gather == Gather::Adjacent || load.gather == Gather::None;
    };
    for (const NodeId ones : both->operands) {
        const auto* load = std::get_if<Load>(&program[ones].form);
        const NodeId bits = both->operands[ones == both->operands[0] ? 1 : 0];
        if (load && narrow_bits[bits.index] && is_chosen_alike(*load) &&
            is_of_few_ones(program[load->buffer]))
            return FewBits{bits, load};
    }
    return std::nullopt;
}

}  // namespace rddlc::ir
