#include "planners/simulation/particles.hpp"

#include "planners/simulation/futures.hpp"
#include "planners/simulation/record_hash.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace rddlc::planners {

using solvers::require_done;

namespace {

// Each particle makes the step so often, until enough of them agree with what was observed.
constexpr int most_tries = 16;
// Where none agrees, or reals are observed, this part of them stays: the nearest ones.
constexpr std::size_t nearest_share = 16;

bool is_real(const RecordColumn& column) {
    return column.scalar == RDDL_REAL;
}

}  // namespace

Particles::Particles(const rddl_simulator& simulator, std::int64_t count, std::int64_t horizon)
    : simulator_(simulator),
      action_size_(static_cast<std::size_t>(simulator.problem->action_size)),
      observation_size_(static_cast<std::size_t>(simulator.problem->observation_size)),
      columns_(record_columns(*simulator.problem, RDDL_OBSERVATION)),
      ranges_(columns_.size()),
      has_reals_(std::ranges::any_of(columns_, is_real)),
      particles_(batch_of_lanes(simulator, count, horizon)),
      steps_(batch_of_lanes(simulator, count, horizon)),
      found_(batch_of_lanes(simulator, count, horizon)),
      seeds_(static_cast<std::size_t>(count)),
      causes_(seeds_.size()),
      sources_(seeds_.size()),
      distances_(seeds_.size()),
      actions_(seeds_.size() * action_size_),
      observations_(seeds_.size() * observation_size_) {}

void Particles::begin(RandomStream& stream) {
    for (std::uint64_t& seed : seeds_) seed = stream.bits();
    require_done(simulator_, simulator_.set_seeds(particles_.get(), 0, count(), seeds_.data()));
    require_done(simulator_, simulator_.reset(particles_.get(), nullptr, nullptr));
    is_lost_ = false;
}

void Particles::update(const std::byte* action, const std::byte* observation,
                       RandomStream& stream) {
    for (std::size_t k = 0; k < seeds_.size(); ++k)
        std::copy_n(action, action_size_, actions_.data() + k * action_size_);
    found_count_ = 0;
    const int tries = has_reals_ ? 1 : most_tries;
    for (int i = 0; i < tries && found_count_ < count(); ++i) {
        try_step(observation, stream);
        keep_those_within(0, stream);
    }
    is_lost_ = found_count_ == 0;
    if (is_lost_ || (has_reals_ && found_count_ < count() / 2)) keep_nearest(stream);
    // Where none of them can be the state, they stay where they were.
    if (found_count_ > 0) resample();
}

// Each particle makes the step, and is at a distance from what was observed: infinite where its
// episode has ended.
void Particles::try_step(const std::byte* observation, RandomStream& stream) {
    for (std::size_t k = 0; k < seeds_.size(); ++k) {
        seeds_[k] = stream.bits();
        sources_[k] = static_cast<std::int64_t>(k);
    }
    require_done(simulator_, simulator_.copy_environments(steps_.get(), 0, count(),
                                                          particles_.get(), sources_.data()));
    require_done(simulator_, simulator_.set_seeds(steps_.get(), 0, count(), seeds_.data()));
    rddl_transition out{};
    out.causes = causes_.data();
    out.observations = observations_.data();
    require_done(simulator_, simulator_.step(steps_.get(), actions_.data(), &out));
    find_ranges();
    for (std::size_t k = 0; k < seeds_.size(); ++k)
        distances_[k] = causes_[k] == RDDL_RUNNING
                            ? distance(observation, observations_.data() + k * observation_size_)
                            : std::numeric_limits<double>::infinity();
}

void Particles::find_ranges() {
    if (!has_reals_) return;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
        if (!is_real(columns_[c])) continue;
        double least = std::numeric_limits<double>::infinity(), most = -least;
        for (std::size_t k = 0; k < seeds_.size(); ++k) {
            const double value =
                real_at(observations_.data() + k * observation_size_ + columns_[c].offset);
            least = std::min(least, value);
            most = std::max(most, value);
        }
        ranges_[c] = most - least;
    }
}

// The number of values that differ; reals by their share of the range.
double Particles::distance(const std::byte* one, const std::byte* other) const {
    double sum = 0;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
        const RecordColumn& column = columns_[c];
        const std::byte *const a = one + column.offset, *const b = other + column.offset;
        if (column.scalar == RDDL_BOOL) {
            sum += *a == *b ? 0 : 1;
        } else if (column.scalar == RDDL_INT) {
            sum += std::memcmp(a, b, 8) == 0 ? 0 : 1;
        } else {
            const double x = real_at(a), y = real_at(b);
            if (x == y) continue;
            const double share = std::abs(x - y) / ranges_[c];
            sum += share < 1 ? share : 1;  // also where it is no number
        }
    }
    return sum;
}

void Particles::keep_nearest(RandomStream& stream) {
    std::vector<double> sorted = distances_;
    const std::size_t wanted = (sorted.size() - 1) / nearest_share;
    std::ranges::nth_element(sorted, sorted.begin() + static_cast<std::ptrdiff_t>(wanted));
    if (std::isfinite(sorted[wanted])) found_count_ = 0;
    keep_those_within(std::isfinite(sorted[wanted]) ? sorted[wanted] : 1e300, stream);
}

// As many as there is room for, from a random one on.
void Particles::keep_those_within(double most, RandomStream& stream) {
    sources_.clear();
    const auto all = static_cast<std::uint32_t>(distances_.size());
    const std::uint32_t first = stream.below(all);
    for (std::uint32_t k = 0; k < all; ++k) {
        const std::uint32_t at = (first + k) % all;
        if (distances_[at] <= most) sources_.push_back(at);
    }
    const auto some = std::min(static_cast<std::int64_t>(sources_.size()), count() - found_count_);
    require_done(simulator_, simulator_.copy_environments(found_.get(), found_count_, some,
                                                          steps_.get(), sources_.data()));
    found_count_ += some;
    sources_.resize(distances_.size());
}

// Each of those that were found as often as the others, as far as the number allows.
void Particles::resample() {
    for (std::int64_t k = 0; k < count(); ++k)
        sources_[static_cast<std::size_t>(k)] = k * found_count_ / count();
    require_done(simulator_, simulator_.copy_environments(particles_.get(), 0, count(),
                                                          found_.get(), sources_.data()));
}

std::int64_t Particles::distinct() const {
    const auto size = static_cast<std::size_t>(simulator_.problem->state_size);
    std::vector<std::byte> states(seeds_.size() * size);
    require_done(simulator_, simulator_.get_state(particles_.get(), 0, count(), states.data()));
    std::vector<std::uint64_t> keys;
    for (std::size_t k = 0; k < seeds_.size(); ++k)
        keys.push_back(hash_of(states.data() + k * size, size));
    std::ranges::sort(keys);
    return std::unique(keys.begin(), keys.end()) - keys.begin();
}

}  // namespace rddlc::planners
