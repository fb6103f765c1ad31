#include "solvers/policies/random_policy.hpp"

#include <rddl/random/random.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

namespace rddlc::solvers {

namespace {

// The policy draws from an "episode" that no environment ever reaches.
constexpr std::uint64_t policy_episode = std::uint64_t{1} << 63;

// The search if not even the default action is legal: how many actions are drawn for one step, and
// then how many that differ from the default in one value only.
constexpr std::uint32_t most_samples = 128;
constexpr std::uint32_t most_single_changes = 256;

std::uint64_t joined(std::uint64_t low, std::uint64_t high) {
    return high << 32 | (low & 0xFFFFFFFF);
}

// 0 .. count - 1; unbiased enough: the error is below count / 2^64.
std::uint64_t below(std::uint64_t count, std::uint64_t bits) {
    __extension__ using Wide = unsigned __int128;
    return static_cast<std::uint64_t>(Wide{bits} * count >> 64);
}

struct IntRange {
    std::int64_t first = 0;
    std::uint64_t count = 0;
};

// The ints between two finite bounds.
IntRange ints_between(double lower, double upper) {
    constexpr double limit = 0x1p62;  // far beyond any sensible bound, and count cannot overflow
    const double first = std::ceil(std::clamp(lower, -limit, limit));
    const double last = std::floor(std::clamp(upper, -limit, limit));
    if (!(first <= last)) return {};
    return {static_cast<std::int64_t>(first), static_cast<std::uint64_t>(last - first) + 1};
}

// See the header; both uniforms are in (0, 1).
double draw_real(double lower, double upper, double u, double v) {
    if (std::isfinite(lower) && std::isfinite(upper))
        return std::clamp(lower + u * (upper - lower), lower, upper);
    if (std::isfinite(lower)) return lower - std::log(u);
    if (std::isfinite(upper)) return upper + std::log(u);
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

template <class T>
void store(std::byte* action, std::size_t offset, T value) {
    std::memcpy(action + offset, &value, sizeof value);
}

}  // namespace

// The random numbers of one action of an environment at one timestep.
struct RandomPolicy::Draws {
    rddl::StreamKey key;
    std::uint32_t step;
    std::uint32_t sample;

    enum Purpose : std::uint32_t { Value = 0, Choice = 1, Reset = 2, Bools = 3 };

    rddl::philox::Block<std::uint64_t> block(Purpose purpose, std::size_t number) const {
        return rddl::philox::generate<rddl::philox::draw_rounds>(
            rddl::philox::Block<std::uint64_t>{step, number, purpose, sample}, {key.low, key.high});
    }
    std::uint64_t bits(Purpose purpose, std::size_t number) const {
        const auto words = block(purpose, number);
        return joined(words[0], words[1]);
    }
};

RandomPolicy::RandomPolicy(const rddl_problem& problem, std::uint64_t seed, Groups groups)
    : problem_(&problem), seed_(seed), groups_(std::move(groups)) {
    for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent& fluent = problem.fluents[f];
        if (fluent.role != RDDL_ACTION) continue;
        for (std::int64_t g = 0; g < fluent.count; ++g) entries_.push_back(entry_of(problem, f, g));
    }
    drawn_per_step_ = entries_.size();
    if (problem.max_nondef_actions >= 0)
        drawn_per_step_ =
            std::min(drawn_per_step_, static_cast<std::size_t>(problem.max_nondef_actions));
    order_.resize(entries_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    partners_.resize(drawn_per_step_);
    std::vector<std::uint8_t> is_grouped(entries_.size());
    for (const std::vector<int>& group : groups_.columns)
        for (const int column : group) is_grouped[static_cast<std::size_t>(column)] = 1;
    for (std::size_t i = 0; i < entries_.size(); ++i)
        if (!is_grouped[i]) alone_.push_back(static_cast<std::uint32_t>(i));
}

RandomPolicy::Entry RandomPolicy::entry_of(const rddl_problem& problem, std::int32_t number,
                                           std::int64_t grounding) {
    const rddl_fluent& fluent = problem.fluents[number];
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Entry entry{Entry::Kind::Bool,
                static_cast<std::uint32_t>(number),
                0,
                fluent.lower ? fluent.lower[grounding] : -infinity,
                fluent.upper ? fluent.upper[grounding] : infinity,
                0,
                0};
    entry.offset = static_cast<std::size_t>(fluent.offset) +
                   static_cast<std::size_t>(grounding) *
                       static_cast<std::size_t>(fluent.scalar == RDDL_BOOL ? 1 : 8);
    if (fluent.range_type >= 0) {
        entry.kind = Entry::Kind::Int;
        entry.count = static_cast<std::uint64_t>(problem.types[fluent.range_type].object_count);
    } else if (fluent.scalar == RDDL_INT) {
        entry.kind = Entry::Kind::Int;
        if (std::isfinite(entry.lower) && std::isfinite(entry.upper)) {
            const IntRange range = ints_between(entry.lower, entry.upper);
            entry.first = range.first;
            entry.count = range.count;
        }
    } else if (fluent.scalar == RDDL_REAL) {
        entry.kind = Entry::Kind::Real;
    }
    return entry;
}

RandomPolicy::Draws RandomPolicy::draws_of(std::int64_t environment, std::int64_t step,
                                           std::uint32_t sample) const {
    return {rddl::stream_key(seed_, static_cast<std::uint64_t>(environment), policy_episode),
            static_cast<std::uint32_t>(step), sample};
}

void RandomPolicy::act(std::int64_t environment, std::int64_t step, std::byte* action) {
    std::copy_n(default_action(), problem_->action_size, action);
    draw_action(draws_of(environment, step, 0), action);
}

// Into the default action.
void RandomPolicy::draw_action(const Draws& draws, std::byte* action) {
    if (drawn_per_step_ == entries_.size()) {
        for (const std::uint32_t i : alone_) draw(entries_[i], draws, i, action);
        draw_groups(draws, action);
        return;
    }
    // The first steps of a Fisher-Yates shuffle choose a subset; swapping back restores the order.
    for (std::size_t i = 0; i < drawn_per_step_; ++i) {
        const std::uint64_t offset = below(order_.size() - i, draws.bits(Draws::Choice, i));
        partners_[i] = i + static_cast<std::size_t>(offset);
        std::swap(order_[i], order_[partners_[i]]);
        draw(entries_[order_[i]], draws, order_[i], action);
    }
    for (std::size_t i = drawn_per_step_; i-- > 0;) std::swap(order_[i], order_[partners_[i]]);
}

void RandomPolicy::draw_groups(const Draws& draws, std::byte* action) const {
    const std::uint64_t none = groups_.may_be_none ? 1 : 0;
    for (const std::vector<int>& group : groups_.columns) {
        const auto first = static_cast<std::size_t>(group.front());
        const std::uint64_t chosen = below(group.size() + none, draws.bits(Draws::Value, first));
        if (chosen == group.size()) continue;
        std::byte& value = action[entries_[static_cast<std::size_t>(group[chosen])].offset];
        value = static_cast<std::byte>(value == std::byte{0});
    }
}

bool RandomPolicy::try_another(std::int64_t environment, std::int64_t step, Search& search,
                               std::byte* action) {
    if (!search.knows_changed) {
        search.changed.clear();
        for (std::uint32_t i = 0; i < entries_.size(); ++i)
            if (is_changed(entries_[i], action)) search.changed.push_back(i);
        search.knows_changed = true;
    }
    if (!search.changed.empty()) {
        reset_some(draws_of(environment, step, search.sample), search, action);
        return true;
    }
    const std::size_t last =
        most_samples + std::min<std::size_t>(entries_.size(), most_single_changes) - 1;
    if (drawn_per_step_ == 0 || search.sample == last) return false;
    search.begin_sample(search.sample + 1);
    if (search.sample < most_samples)
        draw_action(draws_of(environment, step, search.sample), action);
    else
        draw_single_change(environment, step, search.sample, action);
    return true;
}

// One value after the other, beginning anywhere.
void RandomPolicy::draw_single_change(std::int64_t environment, std::int64_t step,
                                      std::uint32_t sample, std::byte* action) const {
    const std::uint64_t begin =
        below(entries_.size(), draws_of(environment, step, most_samples).bits(Draws::Choice, 0));
    const std::size_t chosen = (begin + sample - most_samples) % entries_.size();
    draw(entries_[chosen], draws_of(environment, step, sample), chosen, action);
}

// Goes through all changed values once and chooses each with the probability that makes every
// subset of the wanted size equally likely.
void RandomPolicy::reset_some(const Draws& draws, Search& search, std::byte* action) const {
    std::uint64_t left = search.changed.size(), wanted = std::max<std::uint64_t>(left / 8, 1);
    std::size_t kept = 0;
    for (const std::uint32_t number : search.changed) {
        const Entry& entry = entries_[number];
        if (wanted == 0 || below(left--, draws.bits(Draws::Reset, search.draws++)) >= wanted) {
            search.changed[kept++] = number;
            continue;
        }
        std::copy_n(default_action() + entry.offset, entry.size(), action + entry.offset);
        --wanted;
    }
    search.changed.resize(kept);
}

bool RandomPolicy::is_changed(const Entry& entry, const std::byte* action) const {
    return std::memcmp(action + entry.offset, default_action() + entry.offset, entry.size()) != 0;
}

// Preconditions that forbid the default action often want a fluent to be all true, or one value of
// it.
void RandomPolicy::draw_bool(const Entry& entry, const Draws& draws, std::uint64_t bits,
                             std::byte* action) const {
    enum : std::uint64_t { AtRandom = 0, AllDefault = 1, AllChanged = 2 };
    std::uint64_t how = AtRandom;
    if (draws.sample >= most_samples)
        how = AllChanged;
    else if (draws.sample > 0)
        how = below(3, draws.bits(Draws::Bools, entry.fluent));
    const auto by_default = static_cast<std::uint8_t>(default_action()[entry.offset]);
    store(action, entry.offset,
          how == AllDefault   ? by_default
          : how == AllChanged ? static_cast<std::uint8_t>(1 - by_default)
                              : static_cast<std::uint8_t>(bits >> 63));
}

void RandomPolicy::draw(const Entry& entry, const Draws& draws, std::size_t number,
                        std::byte* action) const {
    const auto words = draws.block(Draws::Value, number);
    const std::uint64_t bits = joined(words[0], words[1]);
    if (entry.kind == Entry::Kind::Bool) return draw_bool(entry, draws, bits, action);
    if (entry.kind == Entry::Kind::Int && entry.count > 0)
        return store(action, entry.offset,
                     entry.first + static_cast<std::int64_t>(below(entry.count, bits)));
    // Bounds between which no int fits: only the default is left.
    if (entry.kind == Entry::Kind::Int && std::isfinite(entry.lower) && std::isfinite(entry.upper))
        return;

    const double value = draw_real(entry.lower, entry.upper,
                                   rddl::open_unit_real(rddl::unit_real(words[0], words[1])),
                                   rddl::open_unit_real(rddl::unit_real(words[2], words[3])));
    if (entry.kind == Entry::Kind::Real) return store(action, entry.offset, value);
    const double inside = std::isfinite(entry.lower)   ? std::ceil(value)
                          : std::isfinite(entry.upper) ? std::floor(value)
                                                       : std::nearbyint(value);
    store(action, entry.offset, static_cast<std::int64_t>(std::clamp(inside, -0x1p62, 0x1p62)));
}

}  // namespace rddlc::solvers
