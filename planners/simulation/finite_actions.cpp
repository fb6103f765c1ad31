#include "planners/simulation/finite_actions.hpp"

#include "solvers/batches/batch.hpp"

#include <algorithm>
#include <cmath>

namespace rddlc::planners {

using solvers::ActionSpace;
using solvers::CategoryHead;

namespace {

double count_of_categories(const ActionSpace& space) {
    double count = 1;
    for (const CategoryHead& head : space.categories) count *= head.count;
    return count;
}

// The greatest number of sets of that many columns that sub-actions can change.
double count_of_sub_actions(const ActionSpace& space) {
    const auto changes = static_cast<double>(space.choices.size() - 1);
    double count = 1, sets = 1;
    for (int size = 1; size <= space.max_sub_actions && size <= changes; ++size) {
        sets *= (changes - size + 1) / size;
        count += sets;
    }
    return count;
}

}  // namespace

std::optional<FiniteActions> FiniteActions::of(const rddl_simulator& simulator,
                                               const ActionSpace& space, std::size_t most) {
    if (!space.reals.empty()) return std::nullopt;
    const double count =
        space.max_sub_actions > 0 ? count_of_sub_actions(space) : count_of_categories(space);
    if (count > static_cast<double>(most)) return std::nullopt;
    FiniteActions actions(simulator, space.may_be_illegal);
    actions.size_ = static_cast<std::size_t>(simulator.problem->action_size);
    if (space.max_sub_actions > 0)
        actions.add_sub_actions(space);
    else
        actions.add_categories(space);
    return actions;
}

void FiniteActions::add(const ActionSpace& space, const std::vector<std::int32_t>& indices) {
    std::vector<float> row(static_cast<std::size_t>(space.column_count));
    solvers::write_action(space, nullptr, indices.data(), row.data());
    records_.resize((count_ + 1) * size_);
    solvers::ActionRecords(*simulator_).write(row.data(), records_.data() + count_ * size_);
    const auto* const none = static_cast<const std::byte*>(simulator_->problem->default_action);
    if (count_ > 0 && std::equal(none, none + size_, record(count_)))
        std::swap_ranges(records_.begin(), records_.begin() + static_cast<std::ptrdiff_t>(size_),
                         records_.begin() + static_cast<std::ptrdiff_t>(count_ * size_));
    ++count_;
}

void FiniteActions::add_categories(const ActionSpace& space) {
    std::vector<std::int32_t> indices(space.categories.size(), 0);
    for (;;) {
        add(space, indices);
        std::size_t h = 0;
        for (; h < indices.size() && ++indices[h] == space.categories[h].count; ++h) indices[h] = 0;
        if (h == indices.size()) return;
    }
}

// Sets in ascending order of their choices, the smaller ones first.
void FiniteActions::add_sub_actions(const ActionSpace& space) {
    std::vector<std::vector<std::int32_t>> sets{{}};
    for (std::size_t s = 0; s < sets.size(); ++s) {
        std::vector<std::int32_t> indices = sets[s];
        indices.resize(static_cast<std::size_t>(space.max_sub_actions), 0);
        add(space, indices);
        if (static_cast<int>(sets[s].size()) == space.max_sub_actions) continue;
        const std::int32_t first = sets[s].empty() ? 1 : sets[s].back() + 1;
        for (auto c = first; c < static_cast<std::int32_t>(space.choices.size()); ++c) {
            const auto column = [&](std::int32_t choice) {
                return space.choices[static_cast<std::size_t>(choice)].column;
            };
            if (!sets[s].empty() && column(c) == column(sets[s].back())) continue;
            sets.push_back(sets[s]);
            sets.back().push_back(c);
        }
    }
}

void FiniteActions::find_legal(const Origin& origin, std::vector<std::uint8_t>& legal) {
    constexpr std::int64_t most_asked = 8;
    legal.assign(count_, 1);
    if (!asks_) return;
    const std::int64_t asked = std::min(origin.count, most_asked);
    for (std::int64_t k = 0; k < asked; ++k)
        ask(origin.batch, origin.first + k * origin.count / asked, legal);
    if (std::ranges::find(legal, 1) == legal.end()) legal.assign(count_, 1);
}

// Actions that are illegal in that environment become so.
void FiniteActions::ask(const rddl_batch* batch, std::int64_t place,
                        std::vector<std::uint8_t>& legal) {
    if (!lanes_) {
        lanes_.emplace(*simulator_, static_cast<std::int64_t>(count_), 0);
        streams_.resize(count_);
        violated_.resize(count_);
    }
    lanes_->begin({batch, place}, streams_);
    solvers::require_done(*simulator_, simulator_->violated_preconditions(
                                           lanes_->batch(), records_.data(), violated_.data()));
    for (std::size_t a = 0; a < count_; ++a) legal[a] = legal[a] && violated_[a] < 0;
}

}  // namespace rddlc::planners
