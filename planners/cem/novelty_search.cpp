#include "planners/cem/novelty_search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace rddlc::planners {

namespace {

constexpr double first_bins = 8;
constexpr double most_bins = 1e6;
// The deviation of actions, in half widths of their bounds: many are at a bound, since that leads
// furthest.
constexpr double search_spread = 1.5;

}  // namespace

NoveltySearch::NoveltySearch(const rddl_simulator& simulator, const solvers::ActionSpace& space,
                             const solvers::ActionRecords& records,
                             std::span<const double> correlations, std::int64_t lanes,
                             std::int64_t horizon)
    : simulator_(simulator),
      state_size_(static_cast<std::size_t>(simulator.problem->state_size)),
      reals_(static_cast<std::size_t>(space.real_count())),
      indices_(static_cast<std::size_t>(space.index_count())),
      futures_(simulator, lanes, horizon),
      legal_(simulator, space, records, lanes),
      cells_(simulator),
      distribution_(space, Spread{search_spread}),
      noise_(static_cast<std::size_t>(lanes), space, correlations),
      population_(static_cast<std::size_t>(lanes), space.real_count(), space.index_count()),
      plan_actions_(space, records, static_cast<std::size_t>(lanes)),
      ran_(static_cast<std::size_t>(lanes)),
      streams_(ran_.size()),
      steps_(ran_.size()),
      states_(ran_.size() * state_size_),
      actions_(ran_.size() * records.record_size()),
      in_table_(std::bit_ceil(2 * ran_.size())) {}

std::optional<double> NoveltySearch::run(const DecisionPoint& point, std::int64_t steps,
                                         RandomStream& stream, BudgetMeter& meter, Plan& best) {
    begin(point, steps, stream);
    for (std::int64_t t = 0; t < steps; ++t) {
        plan_actions_.write(population_, static_cast<std::size_t>(t), {}, actions_.data());
        legal_.make_legal(futures_.batch(), actions_.data());
        if (t % 4 == 0 && meter.is_late()) return {};
        std::ranges::copy(futures_.running(), ran_.begin());
        futures_.step(actions_.data());
        meter.add_steps(futures_.stepped());
        note_best(t + 1, t + 1 == steps);
        if (t + 1 < steps && !go_on(point, t + 1, stream)) break;
    }
    if (!best_) return {};
    write_best(best);
    return best_->value;
}

void NoveltySearch::begin(const DecisionPoint& point, std::int64_t steps, RandomStream& stream) {
    population_.set_steps(steps);
    distribution_.restart(steps);
    distribution_.draw(stream, noise_, population_);
    for (std::uint64_t& each : streams_) each = stream.bits();
    futures_.begin(point.origin, streams_);
    from_.clear();
    best_.reset();
    bins_ = first_bins;
}

// Courses are compared where they end.
void NoveltySearch::note_best(std::int64_t made, bool is_last) {
    for (std::size_t k = 0; k < ran_.size(); ++k) {
        const double value = futures_.value(k);
        if (!ran_[k] || (futures_.is_running(k) && !is_last) || !std::isfinite(value)) continue;
        if (!best_ || value > best_->value) best_ = Course{value, k, made};
    }
}

// One of each cell goes on from its own state, the others from the state of one of these, which is
// chosen at random. False: no course goes on.
bool NoveltySearch::go_on(const DecisionPoint& point, std::int64_t made, RandomStream& stream) {
    solvers::require_done(
        simulator_, simulator_.get_state(futures_.batch(), 0, futures_.count(), states_.data()));
    find_rare(stream);
    if (rare_.empty()) return false;
    const std::size_t lanes = ran_.size(), first = from_.size();
    constexpr std::uint32_t unset = std::numeric_limits<std::uint32_t>::max();
    from_.resize(first + lanes, unset);
    std::uint32_t* const from = from_.data() + first;
    for (const std::uint32_t lane : rare_) from[lane] = lane;
    for (std::size_t k = 0; k < lanes; ++k) {
        if (from[k] != unset) continue;
        from[k] = rare_[stream.below(static_cast<std::uint32_t>(rare_.size()))];
        std::copy_n(states_.data() + from[k] * state_size_, state_size_,
                    states_.data() + k * state_size_);
    }
    std::ranges::fill(steps_, point.step + made);
    futures_.place(states_.data(), steps_);
    futures_.take_values({from, lanes});
    return true;
}

// One lane of each cell, and about so many cells that half of the lanes are free to go elsewhere.
void NoveltySearch::find_rare(RandomStream& stream) {
    cells_.find(states_.data(), futures_.running(), bins_, stream, cell_of_);
    rare_.clear();
    std::ranges::fill(in_table_, -1);
    const std::size_t mask = in_table_.size() - 1;
    for (std::size_t k = 0; k < ran_.size(); ++k) {
        if (!futures_.is_running(k)) continue;
        std::size_t at = scrambled(cell_of_[k]) & mask;
        while (in_table_[at] >= 0 &&
               cell_of_[rare_[static_cast<std::size_t>(in_table_[at])]] != cell_of_[k])
            at = (at + 1) & mask;
        if (in_table_[at] < 0) {
            in_table_[at] = static_cast<std::int32_t>(rare_.size());
            rare_.push_back(static_cast<std::uint32_t>(k));
        } else {
            std::uint32_t& lane = rare_[static_cast<std::size_t>(in_table_[at])];
            if (futures_.value(k) > futures_.value(lane)) lane = static_cast<std::uint32_t>(k);
        }
    }
    constexpr double step = 1.25;
    if (rare_.size() * 4 < ran_.size()) bins_ *= step;
    if (rare_.size() * 2 > ran_.size()) bins_ /= step;
    bins_ = std::clamp(bins_, 1 / most_bins, most_bins);
}

// Goes back from where the best course ended.
void NoveltySearch::write_best(Plan& best) const {
    std::size_t lane = best_->lane;
    for (auto t = static_cast<std::size_t>(best_->steps); t-- > 0;) {
        std::copy_n(population_.numbers(t) + lane * reals_, reals_,
                    best.numbers.begin() + static_cast<std::ptrdiff_t>(t * reals_));
        for (std::size_t i = 0; i < indices_; ++i)
            best.indices[t * indices_ + i] = population_.indices(t, i)[lane];
        if (t > 0) lane = from_[(t - 1) * ran_.size() + lane];
    }
}

}  // namespace rddlc::planners
