#include "solvers/action_distribution/action_distribution.hpp"

#include "solvers/action_distribution/probabilities.hpp"
#include "solvers/batches/batch.hpp"
#include "solvers/spaces/action_repair.hpp"

#include <rddl/values/philox.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rddlc::solvers {

namespace {

// Four words for the coordinates; `what` keeps draws for different things apart.
rddl::philox::Block<std::uint64_t> words_of(const ChoiceKey& key, std::uint32_t what) {
    using namespace rddl::philox;
    return generate<draw_rounds>(
        Block<std::uint64_t>{key.environment & 0xFFFFFFFF, what, key.step & 0xFFFFFFFF,
                             key.environment >> 32 ^ key.step >> 32 << 16},
        Key<std::uint64_t>{key.seed & 0xFFFFFFFF, (key.seed >> 32) ^ 0x50504F});
}

// A number in (0, 1).
float unit(std::uint64_t word) {
    return (static_cast<float>((word & 0xFFFFFFFF) >> 8) + 0.5f) * 0x1p-24f;
}

constexpr std::uint32_t of_categories = 1u << 24;

// Standard normal numbers r and r + 1, for an even r (Box and Muller, 1958).
struct TwoNormals {
    float first, second;
};
TwoNormals normals(const ChoiceKey& key, std::uint32_t r) {
    const auto words = words_of(key, r / 2);
    const float radius = std::sqrt(-2 * std::log(unit(words[0])));
    const float angle = 2 * std::numbers::pi_v<float> * unit(words[1]);
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

const float* log_deviations_of(const Deviations& deviations, std::size_t environment) {
    return deviations.logarithms + environment * static_cast<std::size_t>(deviations.row);
}

int likeliest(int count, const float* logits, const std::uint8_t* mask) {
    int best = -1;
    for (int l = 0; l < count; ++l)
        if ((!mask || mask[l]) && (best < 0 || logits[l] > logits[best])) best = l;
    return best;
}

int draw(int count, const float* logits, const std::uint8_t* mask, float u) {
    const float most = logits[likeliest(count, logits, mask)];
    float sum = 0;
    for (int l = 0; l < count; ++l)
        if (!mask || mask[l]) sum += std::exp(logits[l] - most);
    float left = u * sum;
    int last = -1;
    for (int l = 0; l < count; ++l) {
        if (mask && !mask[l]) continue;
        last = l;
        left -= std::exp(logits[l] - most);
        if (left < 0) break;
    }
    return last;
}

}  // namespace

const char* name_of(Noise noise) {
    return noise == Noise::Sde ? "sde" : noise == Noise::Ar1 ? "ar1" : "white";
}

void standard_normals(const ChoiceKey& key, std::span<float> numbers) {
    for (std::size_t n = 0; n < numbers.size(); n += 2) {
        const TwoNormals two = normals(key, static_cast<std::uint32_t>(n));
        numbers[n] = two.first;
        if (n + 1 < numbers.size()) numbers[n + 1] = two.second;
    }
}

ActionDistribution::ActionDistribution(const rddl_simulator& simulator, const ActionSpace& space,
                                       Noise noise, double correlation, std::int64_t environments)
    : simulator_(simulator),
      space_(space),
      records_(simulator),
      environments_(environments),
      correlated_(noise == Noise::Ar1 && space.real_count() > 0),
      correlation_(static_cast<float>(correlation)),
      fresh_(static_cast<float>(std::sqrt(1 - correlation * correlation))),
      keys_(static_cast<std::size_t>(environments)),
      noise_(keys_.size() * static_cast<std::size_t>(space.real_count())),
      has_noise_(keys_.size()) {
    const auto count = static_cast<std::size_t>(environments);
    if (space.masked || space.may_be_illegal) actions_.resize(count * records_.record_size());
    if (space.masked)
        choice_masks_.resize(count *
                             static_cast<std::size_t>(simulator.action_choice_count(&simulator)));
    if (space.max_sub_actions > 0) changed_.resize(static_cast<std::size_t>(space.column_count));
    if (space.may_be_illegal) repair_ = RepairBuffers(simulator, space, environments);
}

void ActionDistribution::begin_episode(std::int64_t environment) {
    has_noise_[static_cast<std::size_t>(environment)] = 0;
}

void ActionDistribution::write_records(const float* actions) {
    for (std::int64_t i = 0; i < environments_; ++i)
        records_.write(actions + i * space_.column_count,
                       actions_.data() + static_cast<std::size_t>(i) * records_.record_size());
}

void ActionDistribution::choose_all(rddl_batch* batch, const float* outputs, int output_row,
                                    const Deviations& deviations, const Chosen& chosen,
                                    float* actions) {
    const bool random = deviations.logarithms != nullptr;
    if (!random && space_.logit_count == 0) return write_means(batch, outputs, output_row, actions);
    for (std::int64_t i = 0; i < environments_; ++i)
        choose_reals(static_cast<std::size_t>(i), outputs + i * output_row, deviations, chosen);
    if (space_.max_sub_actions > 0)
        choose_sub_actions(batch, outputs, output_row, random, chosen, actions);
    else if (!space_.categories.empty())
        choose_categories(batch, outputs, output_row, random, chosen);

    const int reals = space_.real_count(), indices = space_.index_count();
    const int mask = space_.mask_size();
    for (std::int64_t i = 0; i < environments_ && !is_stopped(stops_); ++i) {
        const float* const numbers = chosen.numbers + i * reals;
        const std::int32_t* const index = chosen.indices + i * indices;
        write_action(space_, numbers, index, actions + i * space_.column_count);
        if (!random) continue;
        chosen.log_probabilities[i] =
            look_at_choice(space_, outputs + i * output_row,
                           log_deviations_of(deviations, static_cast<std::size_t>(i)), numbers,
                           chosen.shifts + i * reals, chosen.spreads[i], index,
                           mask > 0 ? chosen.masks + i * mask : nullptr)
                .log_probability;
    }
    if (space_.may_be_illegal) mend(batch, actions);
}

// The likeliest of reals alone: what the network says.
void ActionDistribution::write_means(rddl_batch* batch, const float* outputs, int output_row,
                                     float* actions) {
    for (std::int64_t i = 0; i < environments_; ++i)
        write_action(space_, outputs + i * output_row, nullptr, actions + i * space_.column_count);
    if (space_.may_be_illegal) mend(batch, actions);
}

void ActionDistribution::choose_reals(std::size_t i, const float* means,
                                      const Deviations& deviations, const Chosen& chosen) {
    const auto reals = static_cast<std::size_t>(space_.real_count());
    float* const numbers = chosen.numbers + i * reals;
    float* const shifts = chosen.shifts + i * reals;
    if (!deviations.logarithms) {
        std::copy_n(means, reals, numbers);
        return;
    }
    if (deviations.noise) {
        chosen.spreads[i] = 1;
        std::fill_n(shifts, reals, 0.0f);
        for (std::size_t r = 0; r < reals; ++r)
            numbers[r] = means[r] + deviations.noise[i * reals + r];
        return;
    }
    const float* const log_deviations = log_deviations_of(deviations, i);
    const bool goes_on = correlated_ && has_noise_[i];
    const float spread = goes_on ? fresh_ : 1.0f;
    chosen.spreads[i] = spread;
    TwoNormals two{};
    for (std::size_t r = 0; r < reals; ++r) {
        if (r % 2 == 0) two = normals(keys_[i], static_cast<std::uint32_t>(r));
        float& noise = noise_[i * reals + r];
        shifts[r] = goes_on ? correlation_ * noise : 0.0f;
        noise = shifts[r] +
                std::exp(log_deviations[r]) * spread * (r % 2 == 0 ? two.first : two.second);
        numbers[r] = means[r] + noise;
    }
    has_noise_[i] = 1;
}

// A value that its precondition forbids, alone, is not chosen; where the default is forbidden, this
// says nothing.
void ActionDistribution::choose_categories(rddl_batch* batch, const float* outputs, int output_row,
                                           bool random, const Chosen& chosen) {
    const auto logits = static_cast<std::size_t>(space_.logit_count);
    const std::size_t choices = space_.logit_of_mask.size();
    if (space_.masked) {
        require_done(simulator_, simulator_.action_mask(batch, nullptr, choice_masks_.data()));
        for (std::size_t i = 0; i < keys_.size(); ++i) {
            std::uint8_t* const mask = chosen.masks + i * logits;
            std::fill_n(mask, logits, std::uint8_t{1});
            const std::uint8_t* const allowed = choice_masks_.data() + i * choices;
            if (!allowed[0]) continue;
            for (std::size_t c = 1; c < choices; ++c)
                if (space_.logit_of_mask[c] >= 0) mask[space_.logit_of_mask[c]] = allowed[c];
        }
    }
    for (std::size_t i = 0; i < keys_.size(); ++i) {
        const float* const row =
            outputs + static_cast<std::ptrdiff_t>(i) * output_row + space_.real_count();
        rddl::philox::Block<std::uint64_t> words{};
        for (std::size_t h = 0; h < space_.categories.size(); ++h) {
            const CategoryHead& head = space_.categories[h];
            const std::uint8_t* const mask =
                space_.masked ? chosen.masks + i * logits + head.first_logit : nullptr;
            if (random && h % 4 == 0)
                words = words_of(keys_[i], of_categories + static_cast<std::uint32_t>(h / 4));
            chosen.indices[i * space_.categories.size() + h] =
                random ? draw(head.count, row + head.first_logit, mask, unit(words[h % 4]))
                       : likeliest(head.count, row + head.first_logit, mask);
        }
    }
}

void ActionDistribution::choose_sub_actions(rddl_batch* batch, const float* outputs, int output_row,
                                            bool random, const Chosen& chosen, float* actions) {
    const auto sub_actions = static_cast<std::size_t>(space_.max_sub_actions);
    const auto logits = static_cast<std::size_t>(space_.logit_count);
    std::fill_n(chosen.indices, keys_.size() * sub_actions, -1);
    bool is_choosing = true;
    for (int p = 0; p < space_.max_sub_actions && is_choosing && !is_stopped(stops_); ++p) {
        if (p > 0) {
            for (std::size_t i = 0; i < keys_.size(); ++i)
                write_action(space_,
                             chosen.numbers + i * static_cast<std::size_t>(space_.real_count()),
                             chosen.indices + i * sub_actions,
                             actions + i * static_cast<std::size_t>(space_.column_count));
            write_records(actions);
        }
        if (space_.asks)
            require_done(simulator_,
                         simulator_.action_mask(batch, p > 0 ? actions_.data() : nullptr,
                                                choice_masks_.data()));
        else
            std::fill(choice_masks_.begin(), choice_masks_.end(), std::uint8_t{1});
        is_choosing = false;
        for (std::size_t i = 0; i < keys_.size(); ++i) {
            std::int32_t* const index = chosen.indices + i * sub_actions;
            if (p > 0 && index[p - 1] <= 0) continue;  // has stopped
            mask_sub_action(i, p, chosen);
            const std::uint8_t* const mask =
                chosen.masks + (i * sub_actions + static_cast<std::size_t>(p)) * logits;
            const float* const row =
                outputs + static_cast<std::ptrdiff_t>(i) * output_row + space_.real_count();
            const auto words = words_of(keys_[i], of_categories + static_cast<std::uint32_t>(p));
            index[p] = random ? draw(space_.logit_count, row, mask, unit(words[0]))
                              : likeliest(space_.logit_count, row, mask);
            is_choosing |= index[p] > 0;
        }
    }
}

// Masks the next sub-action: a choice must be legal then. If no choice is legal, all whose column
// has not changed yet are allowed, since more changes may repair the action.
void ActionDistribution::mask_sub_action(std::size_t i, int sub_action, const Chosen& chosen) {
    const auto sub_actions = static_cast<std::size_t>(space_.max_sub_actions);
    const std::size_t logits = space_.choices.size();
    const std::uint8_t* const allowed =
        choice_masks_.data() +
        i * static_cast<std::size_t>(simulator_.action_choice_count(&simulator_));
    const std::int32_t* const index = chosen.indices + i * sub_actions;
    std::uint8_t* const mask =
        chosen.masks + (i * sub_actions + static_cast<std::size_t>(sub_action)) * logits;
    const auto set_changed = [&](std::uint8_t is_changed) {
        for (int p = 0; p < sub_action; ++p) {
            const int column = space_.choices[static_cast<std::size_t>(index[p])].column;
            if (column >= 0) changed_[static_cast<std::size_t>(column)] = is_changed;
        }
    };
    const auto is_changed = [&](std::size_t c) {
        return c > 0 && changed_[static_cast<std::size_t>(space_.choices[c].column)] != 0;
    };
    set_changed(1);
    bool any = false;
    for (std::size_t c = 0; c < logits; ++c) {
        const Choice& choice = space_.choices[c];
        mask[c] = (choice.of_mask < 0 || allowed[choice.of_mask]) && !is_changed(c);
        any |= mask[c] != 0;
    }
    for (std::size_t c = 0; c < logits && !any; ++c)
        mask[c] = !is_changed(c) && (c > 0 || sub_action > 0);
    set_changed(0);
    if (any) return;
    any = std::any_of(mask, mask + logits, [](std::uint8_t allows) { return allows != 0; });
    if (!any) mask[0] = 1;
}

void ActionDistribution::mend(rddl_batch* batch, float* actions) {
    write_records(actions);
    repaired_ +=
        repair_actions(simulator_, space_, records_, batch, actions, actions_.data(), repair_);
}

}  // namespace rddlc::solvers
