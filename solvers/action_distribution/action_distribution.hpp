// The action distribution: from the outputs of a policy's network to actions, sampled or likeliest.
#pragma once

#include "solvers/batches/stops.hpp"
#include "solvers/spaces/action_repair.hpp"
#include "solvers/spaces/actions.hpp"

#include <rddl/simulator.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rddlc::solvers {

// The noise of reals. Ar1 is correlated in time; Sde depends on the state (ppo/state_noise.hpp).
enum class Noise { White, Ar1, Sde };
const char* name_of(Noise noise);  // "ar1"

// The place for the choices of n environments: rows of the action space's real_count numbers and
// shifts (by how much noise of the step before moved the mean), a spread (the part of the deviation
// that is noise of this step), index_count indices and mask_size bytes.
struct Chosen {
    float* numbers;
    float* shifts;
    float* spreads;
    std::int32_t* indices;
    std::uint8_t* masks;
    float* log_probabilities;
};

// Random numbers that a choice is made with, a function of these alone.
struct ChoiceKey {
    std::uint64_t seed;
    std::uint64_t environment;
    std::uint64_t step;
};

// Independent standard normal numbers.
void standard_normals(const ChoiceKey& key, std::span<float> numbers);

// The standard deviations of the noise that is added to reals.
struct Deviations {
    const float* logarithms = nullptr;  // rows of real_count; NULL: the likeliest is chosen
    int row = 0;                        // from an environment's row to the next; 0: one for all
    const float* noise = nullptr;       // rows of real_count: what was drawn; NULL: draw it
};

class ActionDistribution {
  public:
    // All that is referred to must outlive this.
    ActionDistribution(const rddl_simulator& simulator, const ActionSpace& space, Noise noise,
                       double correlation, std::int64_t environments);

    // Reads a row of outputs for each environment i, writes the chosen indices and numbers and the
    // row of action values. key_of(i) is asked for a ChoiceKey.
    template <class KeyOf>
    void choose(rddl_batch* batch, const float* outputs, int output_row,
                const Deviations& deviations, KeyOf key_of, const Chosen& chosen, float* actions) {
        for (std::int64_t i = 0; i < environments_; ++i)
            keys_[static_cast<std::size_t>(i)] = key_of(i);
        choose_all(batch, outputs, output_row, deviations, chosen, actions);
    }

    // Sets where choosing ends early; what it points to must outlive this.
    void set_stops(const Stops* stops) { stops_ = repair_.stops = stops; }

    // The next choice of the environment is the first of an episode.
    void begin_episode(std::int64_t environment);

    // Noise of the last step, real by real, and whether there was one; for a checkpoint.
    std::vector<float>& noise() { return noise_; }
    std::vector<std::uint8_t>& has_noise() { return has_noise_; }
    // Actions that violated a precondition and were repaired, since the start.
    std::int64_t repaired() const { return repaired_; }

  private:
    void choose_all(rddl_batch* batch, const float* outputs, int output_row,
                    const Deviations& deviations, const Chosen& chosen, float* actions);
    void write_means(rddl_batch* batch, const float* outputs, int output_row, float* actions);
    void choose_reals(std::size_t i, const float* means, const Deviations& deviations,
                      const Chosen& chosen);
    void choose_categories(rddl_batch* batch, const float* outputs, int output_row, bool random,
                           const Chosen& chosen);
    void choose_sub_actions(rddl_batch* batch, const float* outputs, int output_row, bool random,
                            const Chosen& chosen, float* actions);
    void mask_sub_action(std::size_t i, int sub_action, const Chosen& chosen);
    void mend(rddl_batch* batch, float* actions);
    void write_records(const float* actions);

    const rddl_simulator& simulator_;
    const ActionSpace& space_;
    ActionRecords records_;
    std::int64_t environments_;
    bool correlated_;
    float correlation_, fresh_;  // fresh_: sqrt(1 - correlation^2)
    std::vector<ChoiceKey> keys_;
    std::vector<float> noise_;
    std::vector<std::uint8_t> has_noise_;
    std::vector<std::byte> actions_;          // records
    std::vector<std::uint8_t> choice_masks_;  // as the simulator writes them
    std::vector<std::uint8_t> changed_;       // columns, while an environment's mask is made
    RepairBuffers repair_;
    const Stops* stops_ = nullptr;
    std::int64_t repaired_ = 0;
};

}  // namespace rddlc::solvers
