#include "planners/uct/determinised_problem.hpp"

#include <algorithm>
#include <cmath>

namespace rddlc::planners {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

DeterminisedProblem::DeterminisedProblem(std::size_t state_size, double discount)
    : state_size_(state_size),
      discount_(discount),
      states_(1),
      records_(state_size_, std::byte{0}) {}

std::size_t DeterminisedProblem::bytes() const {
    return states_.size() * (sizeof(State) + state_size_) + ids_.bytes() +
           moves_.size() * sizeof(Move) + courses_.size() * sizeof(Course);
}

DeterminisedProblem::StateId DeterminisedProblem::state_of(const std::byte* its_record) {
    return state_of(its_record, hash_of(its_record, state_size_));
}

DeterminisedProblem::StateId DeterminisedProblem::state_of(const std::byte* its_record,
                                                           std::uint64_t key) {
    const auto [id, is_new] = ids_.add(key, static_cast<StateId>(states_.size()));
    if (is_new) {
        states_.emplace_back();
        records_.insert(records_.end(), its_record, its_record + state_size_);
    }
    return id;
}

void DeterminisedProblem::set_depth(std::int64_t depth) {
    depth_ = depth;
    const auto width = static_cast<std::size_t>(depth);
    if (width <= width_) return;
    const std::size_t rows = courses_.size() / width_;
    std::vector<Course> wider(rows * width, {unknown, over});
    for (std::size_t row = 0; row < rows; ++row)
        std::copy_n(courses_.data() + row * width_, width_, wider.data() + row * width);
    courses_.swap(wider);
    width_ = width;
}

void DeterminisedProblem::begin_visit(std::span<const StateId> states) {
    ++visit_;
    front_.clear();
    for (const StateId state : states) {
        if (states_[state].visit == visit_) continue;
        states_[state].visit = visit_;
        front_.push_back(state);
    }
}

std::int64_t DeterminisedProblem::affordable_depth(StateId root, std::int64_t most,
                                                   std::size_t most_states, TypicalSteps& steps,
                                                   BudgetMeter& meter) {
    begin_visit({&root, 1});
    std::size_t met = 0;
    for (std::int64_t depth = 0; depth < most; ++depth) {
        met += front_.size();
        if (depth > 0 && met > most_states) return depth;
        if (!open_front(steps, meter)) return depth;
        move_front(0);
        if (front_.empty()) return most;
    }
    return most;
}

bool DeterminisedProblem::open(std::span<const StateId> states, TypicalSteps& steps,
                               BudgetMeter& meter) {
    begin_visit(states);
    for (std::int64_t left = depth_; left > 0 && !front_.empty(); --left) {
        if (!open_front(steps, meter)) return false;
        move_front(left - 1);
    }
    return true;
}

bool DeterminisedProblem::open_front(TypicalSteps& steps, BudgetMeter& meter) {
    closed_.clear();
    for (const StateId state : front_)
        if (!states_[state].is_open) closed_.push_back(state);
    for (std::size_t first = 0; first < closed_.size(); first += steps.most_states()) {
        const std::size_t count = std::min(steps.most_states(), closed_.size() - first);
        const auto cost = static_cast<std::int64_t>(count) * steps.cost();
        if (!meter.has_room(cost, 0)) return false;
        wanted_.clear();
        for (std::size_t k = 0; k < count; ++k) wanted_.push_back(record(closed_[first + k]));
        steps.run(wanted_);
        meter.add_steps(cost);
        for (std::size_t k = 0; k < count; ++k) take_moves(closed_[first + k], k, steps);
    }
    return true;
}

void DeterminisedProblem::take_moves(StateId state, std::size_t place, const TypicalSteps& steps) {
    const auto first = static_cast<std::uint32_t>(moves_.size());
    bool stays = true;
    twins_.clear();
    keys_.resize(steps.action_count());
    for (std::size_t a = 0; a < steps.action_count(); ++a)
        if (const std::byte* const next = steps.next(place, a)) {
            keys_[a] = hash_of(next, state_size_);
            ids_.prefetch(keys_[a]);
        }
    for (std::size_t a = 0; a < steps.action_count(); ++a) {
        if (!steps.is_legal(place, a)) continue;
        const std::byte* const next = steps.next(place, a);
        const Move move{static_cast<std::uint32_t>(a), next ? state_of(next, keys_[a]) : over,
                        steps.reward(place, a)};
        (has_twin(first, move) ? twins_ : moves_).push_back(move);
        stays = stays && steps.is_unchanged(place, a) && move.reward == moves_[first].reward;
    }
    State& its = states_[state];
    its.row = static_cast<std::uint32_t>(courses_.size() / width_);
    courses_.resize(courses_.size() + width_, {unknown, over});
    its.first_move = first;
    its.move_count = static_cast<std::uint32_t>(moves_.size()) - first;
    its.twin_count = static_cast<std::uint32_t>(twins_.size());
    its.stays = stays;
    its.is_open = true;
    moves_.insert(moves_.end(), twins_.begin(), twins_.end());
}

bool DeterminisedProblem::has_twin(std::size_t first, const Move& move) const {
    for (std::size_t m = first; m < moves_.size(); ++m)
        if (moves_[m].next == move.next && moves_[m].reward == move.reward) return true;
    return false;
}

void DeterminisedProblem::add_comparison(StateId state, std::int32_t draws,
                                         std::span<const std::uint8_t> differs) {
    State& its = states_[state];
    its.compared += draws;
    Move* const twins = moves_.data() + its.first_move + its.move_count;
    twins_.assign(twins, twins + its.twin_count);
    std::size_t place = 0;
    for (const bool wanted : {true, false})
        for (std::size_t t = 0; t < twins_.size(); ++t)
            if ((differs[t] != 0) == wanted) twins[place++] = twins_[t];
    const auto found = static_cast<std::uint32_t>(
        std::ranges::count_if(differs, [](std::uint8_t differs_too) { return differs_too != 0; }));
    its.move_count += found;
    its.twin_count -= found;
}

// States that were met already, or whose values are known to the end of the search, are not visited
// again.
void DeterminisedProblem::move_front(std::int64_t steps_left) {
    next_front_.clear();
    for (const StateId state : front_)
        for (const Move& move : moves(state)) {
            State& next = states_[move.next];
            if (move.next == over || next.visit == visit_) continue;
            next.visit = visit_;
            if (steps_left > 0 && is_known(move.next, steps_left)) continue;
            next_front_.push_back(move.next);
        }
    front_.swap(next_front_);
}

bool DeterminisedProblem::is_known(StateId state, std::int64_t steps) const {
    return is_open(state) && !std::isnan(courses_[place_of(state, steps)].value);
}

DeterminisedProblem::Course DeterminisedProblem::after(const Move& move, std::int64_t steps) {
    if (steps == 1 || move.next == over) return {move.reward, move.next};
    const Course rest = best(move.next, steps - 1);
    return {move.reward + discount_ * rest.value, rest.end};
}

DeterminisedProblem::Course DeterminisedProblem::best(StateId state, std::int64_t steps) {
    const std::size_t place = place_of(state, steps);
    if (!std::isnan(courses_[place].value)) return courses_[place];
    Course found{-std::numeric_limits<double>::infinity(), over};
    for (const Move& move : moves(state)) {
        const Course course = after(move, steps);
        if (course.value > found.value) found = course;
    }
    return courses_[place] = found;
}

}  // namespace rddlc::planners
