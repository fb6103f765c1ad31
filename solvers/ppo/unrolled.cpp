#include "solvers/ppo/unrolled.hpp"

#include <algorithm>

namespace rddlc::solvers {

Unrolled::Unrolled(const PpoModel& model, std::size_t segments, std::size_t longest)
    : model_(&model) {
    const std::size_t rows = segments * longest;
    const auto units = static_cast<std::size_t>(model.memory.padded_units);
    order_.reserve(segments);
    counts_.reserve(longest);
    begins_.reserve(rows);
    for (auto* each : {&initial_, &scratch_}) each->resize(segments * units);
    for (auto* each : {&before_, &d_memory_}) each->resize(rows * units);
    values_.resize(rows * static_cast<std::size_t>(model.memory.values()));
}

void Unrolled::lay_out(const Experience& experience, std::span<const std::uint32_t> segments,
                       std::vector<std::uint32_t>& samples) {
    const Segments& all = experience.segments;
    order_.assign(segments.begin(), segments.end());
    std::partition(order_.begin(), order_.end(),
                   [&](std::uint32_t segment) { return all.length(segment) == all.longest(); });
    samples.clear();
    counts_.clear();
    begins_.clear();
    for (int t = 0; t < all.longest(); ++t) {
        int count = 0;
        for (const std::uint32_t segment : order_) {
            if (t == all.length(segment)) break;
            const std::uint32_t sample = all.sample(segment, t);
            samples.push_back(sample);
            // The state before the first step is in the experience.
            const auto last = sample - static_cast<std::uint32_t>(experience.environments);
            begins_.push_back(t > 0 ? experience.ends[last] : 0);
            ++count;
        }
        if (count > 0) counts_.push_back(count);
    }
    const auto units = static_cast<std::size_t>(model_->memory.padded_units);
    for (std::size_t s = 0; s < order_.size(); ++s)
        std::copy_n(experience.memories.data() + order_[s] * units, units,
                    initial_.data() + s * units);
    std::fill_n(d_memory_.begin(), samples.size() * units, 0.0f);
}

void Unrolled::remember(float* inputs) {
    gru_functions().forward(model_->memory, model_->memory_parameters(), sequence(), inputs,
                            model_->input_row(), initial_.data(), before_.data(), values_.data(),
                            inputs + model_->features(), model_->input_row());
}

void Unrolled::add_gradient(const float* inputs, const float* rows, float* gradient) {
    gru_functions().backward(model_->memory, rows, sequence(), inputs, model_->input_row(),
                             before_.data(), values_.data(), d_memory_.data(), scratch_.data(),
                             gradient);
}

}  // namespace rddlc::solvers
