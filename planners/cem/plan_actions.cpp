#include "planners/cem/plan_actions.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace rddlc::planners {

using solvers::CategoryHead;
using solvers::RealHead;

namespace {

RealScale scale_of(const RealHead& head, const solvers::ActionSpace& space,
                   const solvers::ActionRecords& records) {
    return {head.range,
            head.rounds,
            head.lower,
            head.upper,
            head.scale,
            head.centre,
            head.least(),
            head.most(),
            space.defaults[static_cast<std::size_t>(head.column)],
            records.default_value(head.column)};
}

// The inverse of the loops' bent().
double straightened(double value) {
    constexpr double from = half_bend;
    return value < from ? 2 * std::sqrt(from * std::max(value, 0.0)) - from : value;
}

}  // namespace

void read_plan_action(const solvers::ActionSpace& space, const float* row, float* numbers,
                      std::int32_t* indices) {
    solvers::read_action(space, row, numbers, indices);
    for (std::size_t r = 0; r < space.reals.size(); ++r) {
        const RealHead& head = space.reals[r];
        const auto value = static_cast<double>(row[head.column]);
        if (head.range == RealHead::Range::AboveLower)
            numbers[r] = static_cast<float>(straightened((value - head.lower) / head.scale));
        else if (head.range == RealHead::Range::BelowUpper)
            numbers[r] = static_cast<float>(straightened((head.upper - value) / head.scale));
    }
}

PlanActions::PlanActions(const solvers::ActionSpace& space, const solvers::ActionRecords& records,
                         std::size_t most_plans)
    : loops_(plan_loops()),
      space_(space),
      records_(records),
      blank_(most_plans * records.record_size()),
      numbers_(most_plans),
      values_(most_plans * std::max<std::size_t>(1, space.reals.size())),
      writes_all_(space.max_sub_actions == 0 &&
                  space.reals.size() * sizeof(double) == records.record_size()) {
    for (std::size_t p = 0; p < most_plans; ++p)
        std::ranges::copy(records.default_record(),
                          blank_.begin() + static_cast<std::ptrdiff_t>(p * records.record_size()));
}

void PlanActions::write(const Population& population, std::size_t step,
                        std::span<const std::uint32_t> plans, std::byte* to) {
    plans_ = plans;
    count_ = plans.empty() ? population.plans() : plans.size();
    if (!writes_all_) std::memcpy(to, blank_.data(), count_ * records_.record_size());
    if (space_.max_sub_actions > 0) return write_sub_actions(population, step, to);
    for (std::size_t r = 0; r < space_.reals.size(); ++r)
        write_real(space_.reals[r], numbers_of(population, step, r), to);
    for (std::size_t h = 0; h < space_.categories.size(); ++h)
        write_category(space_.categories[h], population.indices(step, h), to);
}

// The numbers of the plans that are written.
const float* PlanActions::numbers_of(const Population& population, std::size_t step,
                                     std::size_t real) {
    const float* const all = population.numbers(step, real);
    if (plans_.empty()) return all;
    for (std::size_t k = 0; k < count_; ++k) numbers_[k] = all[plans_[k]];
    return numbers_.data();
}

void PlanActions::write_real(const RealHead& head, const float* numbers, std::byte* to) {
    loops_.real_values(scale_of(head, space_, records_), numbers, count_, values_.data());
    const auto at = records_.entry(head.column);
    const std::size_t size = records_.record_size(), count = count_;
    const double* const values = values_.data();
    if (at.scalar == RDDL_REAL)  // apart, since it is most of the work where it occurs
        for (std::size_t k = 0; k < count; ++k)
            std::memcpy(to + k * size + at.offset, values + k, sizeof values[k]);
    else
        for (std::size_t k = 0; k < count; ++k) at.set(values[k], to + k * size);
}

void PlanActions::write_category(const CategoryHead& head, const std::int32_t* indices,
                                 std::byte* to) {
    const std::size_t size = records_.record_size();
    for (std::size_t k = 0; k < count_; ++k) {
        const std::int64_t value = head.first_value + indices[plan_at(k)];
        if (head.group.empty()) {
            records_.entry(head.column).set(static_cast<double>(value), to + k * size);
        } else if (value > 0) {
            const int column = head.group[static_cast<std::size_t>(value - 1)];
            records_.entry(column).set(1 - records_.default_value(column), to + k * size);
        }
    }
}

void PlanActions::write_sub_actions(const Population& population, std::size_t step, std::byte* to) {
    const std::size_t size = records_.record_size(), row = blank_.size() / size;
    for (std::size_t r = 0; r < space_.reals.size(); ++r)
        loops_.real_values(scale_of(space_.reals[r], space_, records_),
                           numbers_of(population, step, r), count_, values_.data() + r * row);
    const auto positions = static_cast<std::size_t>(space_.max_sub_actions);
    for (std::size_t p = 0; p < positions; ++p) {
        const std::int32_t* const indices = population.indices(step, p);
        bool any = false;
        for (std::size_t k = 0; k < count_; ++k) {
            const std::int32_t index = indices[plan_at(k)];
            if (index == 0) continue;  // and so are those after it
            any = true;
            const solvers::Choice& choice = space_.choices[static_cast<std::size_t>(index)];
            const double value = choice.real >= 0
                                     ? values_[static_cast<std::size_t>(choice.real) * row + k]
                                     : static_cast<double>(choice.value);
            records_.entry(choice.column).set(value, to + k * size);
        }
        if (!any) return;
    }
}

}  // namespace rddlc::planners
