#include "solvers/ppo/policy.hpp"

#include "solvers/action_distribution/action_distribution.hpp"
#include "solvers/batches/batch.hpp"
#include "solvers/files/fingerprint.hpp"
#include "solvers/ppo/memories.hpp"
#include "solvers/ppo/state_noise.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace rddlc::solvers {

namespace {

struct PpoActor {
    PpoActor(const rddl_simulator& its_simulator, std::shared_ptr<const PpoModel> its_model,
             bool its_random, std::uint64_t its_seed, std::int64_t environments)
        : simulator(its_simulator),
          model(std::move(its_model)),
          random(its_random),
          seed(its_seed),
          records(simulator),
          distribution(simulator, model->actions, model->noise, model->correlation, environments),
          state_noise(*model, environments),
          memories(*model, environments) {
        if (state_noise.is_used()) state_noise.look_at_policy();
        const auto count = static_cast<std::size_t>(environments);
        const auto rows = [&](int row) {
            return count * static_cast<std::size_t>(row);
        };
        observations.resize(rows(model->observations.column_count()));
        features.resize(rows(model->features()));
        inputs.resize(rows(model->input_row()));
        outputs.resize(rows(model->policy.padded_outputs()));
        activations.resize(tile * model->policy.activations);
        numbers.resize(rows(model->actions.real_count()));
        shifts.resize(numbers.size());
        spreads.resize(count);
        log_probabilities.resize(count);
        indices.resize(rows(model->actions.index_count()));
        masks.resize(rows(model->actions.mask_size()));
        actions.resize(rows(model->actions.column_count));
    }

    void act(Decision& decision) {
        distribution.set_stops(decision.stops);
        const std::int64_t count = static_cast<std::int64_t>(decision.running.size());
        const int width = model->features(), row = model->input_row();
        const int output_row = model->policy.padded_outputs();
        require_done(simulator, simulator.get_observation_values(decision.batch, RDDL_FLOAT,
                                                                 observations.data()));
        for (std::int64_t e = 0; e < count; ++e) {
            const std::int64_t steps = decision.steps[static_cast<std::size_t>(e)];
            write_features(model->observations,
                           observations.data() + e * model->observations.column_count(), steps,
                           steps == 0, features.data() + e * width);
            model->normaliser.write(features.data() + e * width, inputs.data() + e * row);
            if (steps > 0) continue;
            distribution.begin_episode(e);
            state_noise.begin_episode(e);
            memories.begin_episode(e);
        }
        const auto key_of = [&](std::int64_t e) {
            const auto at = static_cast<std::size_t>(e);
            return ChoiceKey{seed, static_cast<std::uint64_t>(decision.episodes[at]),
                             static_cast<std::uint64_t>(decision.steps[at])};
        };
        for (std::int64_t e = 0; e < count; e += tile) {
            const int some = static_cast<int>(std::min<std::int64_t>(tile, count - e));
            memories.remember(e, some, inputs.data() + e * row);
            network_functions().forward(model->policy, model->parameters.data(), some,
                                        inputs.data() + e * row, row, activations.data());
            std::copy_n(activations.data() +
                            model->policy.layers.back().values * static_cast<std::size_t>(some),
                        some * output_row, outputs.data() + e * output_row);
            for (int i = 0; i < some && random && state_noise.is_used(); ++i)
                state_noise.make(e + i,
                                 last_hidden(model->policy, activations.data(), some) +
                                     i * hidden_row(model->policy),
                                 key_of(e + i));
        }
        const Chosen chosen{numbers.data(), shifts.data(), spreads.data(),
                            indices.data(), masks.data(),  log_probabilities.data()};
        distribution.choose(decision.batch, outputs.data(), output_row,
                            !random                 ? Deviations{}
                            : state_noise.is_used() ? state_noise.deviations()
                                                    : Deviations{model->log_deviations()},
                            key_of, chosen, actions.data());
        for (std::int64_t e = 0; e < count; ++e)
            records.write(actions.data() + e * model->actions.column_count,
                          decision.actions + static_cast<std::size_t>(e) * records.record_size());
    }

    const rddl_simulator& simulator;
    std::shared_ptr<const PpoModel> model;
    bool random;
    std::uint64_t seed;
    ActionRecords records;
    ActionDistribution distribution;
    StateNoise state_noise;
    Memories memories;
    std::vector<float> observations, features, inputs, outputs, activations, numbers, shifts,
        spreads, log_probabilities, actions;
    std::vector<std::int32_t> indices;
    std::vector<std::uint8_t> masks;
};

}  // namespace

Policy ppo_policy(const rddl_simulator& simulator, std::shared_ptr<const PpoModel> model,
                  bool random, std::uint64_t seed, std::string name) {
    return {std::move(name), spaces_of(simulator),
            [&simulator, model, random, seed](std::int64_t environments) -> Actor {
                const auto actor =
                    std::make_shared<PpoActor>(simulator, model, random, seed, environments);
                return [actor](Decision& decision) {
                    actor->act(decision);
                };
            }};
}

}  // namespace rddlc::solvers
