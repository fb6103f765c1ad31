#include "planners/simulation/state_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace rddlc::planners {

namespace {

// A state of more values is divided by so many of them, chosen anew each time.
constexpr std::size_t most_columns = 64;

double value_at(const std::byte* at, rddl_scalar scalar) {
    if (scalar == RDDL_BOOL) return *at == std::byte{0} ? 0 : 1;
    if (scalar == RDDL_INT) {
        std::int64_t number = 0;
        std::memcpy(&number, at, sizeof number);
        return static_cast<double>(number);
    }
    return real_at(at);
}

}  // namespace

StateCells::StateCells(const rddl_simulator& simulator)
    : state_size_(static_cast<std::size_t>(simulator.problem->state_size)),
      columns_(record_columns(*simulator.problem, RDDL_STATE)) {}

void StateCells::find(const std::byte* states, std::span<const std::uint8_t> wanted, double bins,
                      RandomStream& stream, std::vector<std::uint64_t>& cells) {
    cells.assign(wanted.size(), 0);
    const std::size_t count = std::min(columns_.size(), most_columns);
    for (std::size_t k = 0; k < count; ++k) {
        if (columns_.size() > most_columns)
            std::swap(columns_[k],
                      columns_[k + stream.below(static_cast<std::uint32_t>(columns_.size() - k))]);
        divide(columns_[k], states, wanted, bins, stream, cells);
    }
}

void StateCells::divide(const RecordColumn& column, const std::byte* states,
                        std::span<const std::uint8_t> wanted, double bins, RandomStream& stream,
                        std::vector<std::uint64_t>& cells) {
    const double offset = stream.unit();
    double least = std::numeric_limits<double>::infinity(), most = -least;
    values_.resize(wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        if (!wanted[k]) continue;
        values_[k] = value_at(states + k * state_size_ + column.offset, column.scalar);
        if (!std::isfinite(values_[k])) continue;
        least = std::min(least, values_[k]);
        most = std::max(most, values_[k]);
    }
    if (!(most > least) || !std::isfinite(most - least)) return;
    const double scale = bins / (most - least);
    for (std::size_t k = 0; k < wanted.size(); ++k)
        if (wanted[k] && std::isfinite(values_[k]))
            cells[k] = scrambled(cells[k] +
                                 static_cast<std::uint64_t>((values_[k] - least) * scale + offset));
}

}  // namespace rddlc::planners
