#include "solvers/ppo/policy.hpp"

#include "solvers/action_distribution/action_distribution.hpp"
#include "solvers/batches/batch.hpp"
#include "solvers/files/fingerprint.hpp"
#include "solvers/ppo/memories.hpp"
#include "solvers/ppo/state_noise.hpp"

#include <algorithm>
#include <cmath>
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

// A network in the states of a batch, for policies that know them from a state alone.
class NetworkOfStates {
  public:
    NetworkOfStates(const rddl_simulator& simulator, const PpoModel& model, const Network& network,
                    const float* parameters, std::int64_t environments)
        : simulator_(simulator), model_(model), network_(network), parameters_(parameters) {
        const auto count = static_cast<std::size_t>(environments);
        observations_.resize(count * static_cast<std::size_t>(model.observations.column_count()));
        features_.resize(static_cast<std::size_t>(model.features()));
        inputs_.resize(count * static_cast<std::size_t>(model.input_row()));
        activations_.resize(tile * network.activations);
    }

    // visit(outputs) for one environment after the other.
    template <class Visit>
    void look(rddl_batch* batch, std::span<const std::int64_t> steps, Visit&& visit) {
        const auto count = static_cast<std::int64_t>(steps.size());
        const int row = model_.input_row();
        require_done(simulator_,
                     simulator_.get_observation_values(batch, RDDL_FLOAT, observations_.data()));
        for (std::int64_t e = 0; e < count; ++e) {
            write_features(model_.observations,
                           observations_.data() + e * model_.observations.column_count(),
                           steps[static_cast<std::size_t>(e)], true, features_.data());
            model_.normaliser.write(features_.data(), inputs_.data() + e * row);
        }
        for (std::int64_t e = 0; e < count; e += tile) {
            const int some = static_cast<int>(std::min<std::int64_t>(tile, count - e));
            network_functions().forward(network_, parameters_, some, inputs_.data() + e * row, row,
                                        activations_.data());
            const float* const outputs = activations_.data() + network_.layers.back().values *
                                                                   static_cast<std::size_t>(some);
            for (int i = 0; i < some; ++i) visit(outputs + i * network_.padded_outputs());
        }
    }

  private:
    const rddl_simulator& simulator_;
    const PpoModel& model_;
    const Network& network_;
    const float* parameters_;
    std::vector<float> observations_, features_, inputs_, activations_;
};

// The policy's tendencies to some actions, by its logits. Masks leave out what is illegal, which
// the caller knows.
struct PpoPriors {
    PpoPriors(const rddl_simulator& simulator, std::shared_ptr<const PpoModel> its_model,
              std::int64_t environments, std::span<const std::byte> actions)
        : model(std::move(its_model)),
          network(simulator, *model, model->policy, model->parameters.data(), environments) {
        logarithms.resize(static_cast<std::size_t>(model->actions.logit_count));
        const ActionRecords records(simulator);
        const auto width = static_cast<std::size_t>(model->actions.index_count());
        std::vector<float> row(static_cast<std::size_t>(model->actions.column_count));
        for (std::size_t a = 0; a * records.record_size() < actions.size(); ++a) {
            records.read(actions.data() + a * records.record_size(), row.data());
            indices.resize(indices.size() + width);
            read_action(model->actions, row.data(), nullptr, indices.data() + a * width);
        }
    }

    void write(rddl_batch* batch, std::span<const std::int64_t> steps, float* rows) {
        network.look(batch, steps, [&](const float* outputs) {
            rows = write_row(outputs + model->actions.real_count(), rows);
        });
    }

    // Writes the row of one environment; returns the place of the next one.
    float* write_row(const float* logits, float* row) {
        const ActionSpace& space = model->actions;
        if (space.max_sub_actions > 0) find_sub_actions(logits);
        for (const CategoryHead& head : space.categories)
            find_logarithms(head.first_logit, head.count, logits);
        const auto width = static_cast<std::size_t>(space.index_count());
        for (std::size_t a = 0; a * width < indices.size(); ++a) {
            const std::int32_t* const index = indices.data() + a * width;
            float sum = space.max_sub_actions > 0 ? of_sub_actions(index) : 0;
            for (std::size_t h = 0; h < space.categories.size(); ++h)
                sum += logarithms[static_cast<std::size_t>(space.categories[h].first_logit +
                                                           index[h])];
            *row++ = sum;
        }
        return row;
    }

    void find_sub_actions(const float* logits) {
        const ActionSpace& space = model->actions;
        find_logarithms(0, space.logit_count, logits);
        shares.assign(static_cast<std::size_t>(space.column_count), 0.0f);
        for (std::size_t c = 1; c < space.choices.size(); ++c)
            shares[static_cast<std::size_t>(space.choices[c].column)] += std::exp(logarithms[c]);
    }

    // The likeliest sub-action first, as the policy takes them. Each leaves out the choices of its
    // column for those after it: else to stop at once would be likelier than any sub-action. The
    // choice to stop, 0, is the last one.
    float of_sub_actions(const std::int32_t* index) {
        const ActionSpace& space = model->actions;
        const std::int32_t* const end = index + space.max_sub_actions;
        order.assign(index, std::find(index, end, 0));
        std::ranges::sort(order, [&](std::int32_t a, std::int32_t b) {
            return logarithms[static_cast<std::size_t>(a)] >
                   logarithms[static_cast<std::size_t>(b)];
        });
        if (order.size() < static_cast<std::size_t>(space.max_sub_actions)) order.push_back(0);
        const float stop = std::exp(logarithms.front());
        float sum = 0, left = 1;
        for (const std::int32_t choice : order) {
            const auto c = static_cast<std::size_t>(choice);
            sum += logarithms[c] - std::log(left);
            if (c > 0)  // `left` has an error, but to stop is always possible
                left = std::max({left - shares[static_cast<std::size_t>(space.choices[c].column)],
                                 stop, 1e-30f});
        }
        return sum;
    }

    // Logarithms of the probabilities of a category.
    void find_logarithms(int first, int count, const float* logits) {
        const float most = *std::max_element(logits + first, logits + first + count);
        float sum = 0;
        for (int l = first; l < first + count; ++l) sum += std::exp(logits[l] - most);
        for (int l = first; l < first + count; ++l)
            logarithms[static_cast<std::size_t>(l)] = logits[l] - most - std::log(sum);
    }

    std::shared_ptr<const PpoModel> model;
    NetworkOfStates network;
    std::vector<std::int32_t> indices;  // rows of index_count
    std::vector<std::int32_t> order;    // sub-actions, the likeliest first
    std::vector<float> logarithms;
    std::vector<float> shares;  // the probability that a sub-action changes a column
};

// Estimates of what the policy still gets paid.
struct PpoValues {
    PpoValues(const rddl_simulator& simulator, std::shared_ptr<const PpoModel> its_model,
              std::int64_t environments)
        : model(std::move(its_model)),
          network(simulator, *model, model->value, model->value_parameters(), environments) {}

    void write(rddl_batch* batch, std::span<const std::int64_t> steps, double* values) {
        network.look(batch, steps, [&](const float* outputs) {
            *values++ = static_cast<double>(*outputs) * model->value_scale;
        });
    }

    std::shared_ptr<const PpoModel> model;
    NetworkOfStates network;
};

// Only a policy that sees all of a state in its features knows priors and values from a state
// alone.
bool sees_states(const rddl_simulator& simulator, const PpoModel& model) {
    return model.recurrent == 0 && !simulator.problem->partially_observed;
}

}  // namespace

Policy ppo_policy(const rddl_simulator& simulator, std::shared_ptr<const PpoModel> model,
                  bool random, std::uint64_t seed, std::string name) {
    const auto start = [&simulator, model, random, seed](std::int64_t environments) -> Actor {
        const auto actor = std::make_shared<PpoActor>(simulator, model, random, seed, environments);
        return [actor](Decision& decision) {
            actor->act(decision);
        };
    };
    Policy policy{std::move(name), spaces_of(simulator), start};
    if (!sees_states(simulator, *model)) return policy;
    if (model->actions.real_count() == 0)
        policy.priors = [&simulator, model](std::int64_t environments,
                                            std::span<const std::byte> actions) -> ActionPriors {
            const auto priors =
                std::make_shared<PpoPriors>(simulator, model, environments, actions);
            return [priors](rddl_batch* batch, std::span<const std::int64_t> steps, float* rows) {
                priors->write(batch, steps, rows);
            };
        };
    policy.value_discount = model->value_discount;
    if (model->value_scale > 0)
        policy.values = [&simulator, model](std::int64_t environments) -> StateValues {
            const auto values = std::make_shared<PpoValues>(simulator, model, environments);
            return [values](rddl_batch* batch, std::span<const std::int64_t> steps, double* rows) {
                values->write(batch, steps, rows);
            };
        };
    return policy;
}

}  // namespace rddlc::solvers
