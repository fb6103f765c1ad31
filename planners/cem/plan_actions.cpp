#include "planners/cem/plan_actions.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace rddlc::planners {

using solvers::CategoryHead;
using solvers::RealHead;

namespace {

RealScales scales_of(const solvers::ActionSpace& space, const solvers::ActionRecords& records) {
    std::vector<RealScale> scales;
    for (const RealHead& head : space.reals)
        scales.push_back({head.range, head.rounds, head.lower, head.upper, head.scale, head.centre,
                          head.least(), head.most(),
                          space.defaults[static_cast<std::size_t>(head.column)],
                          records.default_value(head.column)});
    return RealScales(scales);
}

// The number whose value is so much from the bound: the inverse of the loops' parabola.
double straightened(double value) {
    constexpr double from = half_bend;
    return value < from ? 2 * std::sqrt(from * std::max(value, 0.0)) : value + from;
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
        else
            numbers[r] += middle_number(head.range);
        const auto [least, most] = number_limits(head);
        numbers[r] = std::clamp(numbers[r], least, most);
    }
}

PlanActions::PlanActions(const solvers::ActionSpace& space, const solvers::ActionRecords& records,
                         std::size_t most_plans)
    : loops_(plan_loops()),
      space_(space),
      records_(records),
      scales_(scales_of(space, records)),
      blank_(most_plans * records.record_size()),
      numbers_(most_plans * space.reals.size()),
      values_(most_plans * space.reals.size()),
      values_are_records_(are_records(space)) {
    for (std::size_t p = 0; p < most_plans; ++p)
        std::ranges::copy(records.default_record(),
                          blank_.begin() + static_cast<std::ptrdiff_t>(p * records.record_size()));
}

void PlanActions::write(const Population& population, std::size_t step,
                        std::span<const std::uint32_t> plans, std::byte* to) {
    plans_ = plans;
    count_ = plans.empty() ? population.plans() : plans.size();
    const std::size_t reals = space_.reals.size();
    const auto write_values = [&](double* values) {
        loops_.real_values(scales_, numbers_of(population, step), count_ * reals, values);
    };
    if (values_are_records_) return write_values(reinterpret_cast<double*>(to));
    std::memcpy(to, blank_.data(), count_ * records_.record_size());
    if (reals > 0) write_values(values_.data());
    if (space_.max_sub_actions > 0) return write_sub_actions(population, step, to);
    for (std::size_t r = 0; r < reals; ++r) write_real(r, to);
    for (std::size_t h = 0; h < space_.categories.size(); ++h)
        write_category(space_.categories[h], population.indices(step, h), to);
}

// Whether a row of values is a record: all of it are reals, in their order.
bool PlanActions::are_records(const solvers::ActionSpace& space) const {
    if (space.max_sub_actions > 0 || space.reals.empty() ||
        space.reals.size() * sizeof(double) != records_.record_size())
        return false;
    for (std::size_t r = 0; r < space.reals.size(); ++r) {
        const auto& at = records_.entry(space.reals[r].column);
        if (at.scalar != RDDL_REAL || at.offset != r * sizeof(double)) return false;
    }
    return true;
}

// The numbers of the plans that are written.
const float* PlanActions::numbers_of(const Population& population, std::size_t step) {
    const float* const all = population.numbers(step);
    const std::size_t reals = population.reals();
    if (plans_.empty()) return all;
    for (std::size_t k = 0; k < count_; ++k)
        std::copy_n(all + plans_[k] * reals, reals, numbers_.data() + k * reals);
    return numbers_.data();
}

void PlanActions::write_real(std::size_t real, std::byte* to) {
    const auto at = records_.entry(space_.reals[real].column);
    const std::size_t size = records_.record_size(), count = count_, reals = space_.reals.size();
    const double* const values = values_.data() + real;
    if (at.scalar == RDDL_REAL)  // apart, since it is most of the work where it occurs
        for (std::size_t k = 0; k < count; ++k)
            std::memcpy(to + k * size + at.offset, values + k * reals, sizeof *values);
    else
        for (std::size_t k = 0; k < count; ++k) at.set(values[k * reals], to + k * size);
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
    const std::size_t size = records_.record_size(), reals = space_.reals.size();
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
                                     ? values_[k * reals + static_cast<std::size_t>(choice.real)]
                                     : static_cast<double>(choice.value);
            records_.entry(choice.column).set(value, to + k * size);
        }
        if (!any) return;
    }
}

}  // namespace rddlc::planners
