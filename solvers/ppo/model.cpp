#include "solvers/ppo/model.hpp"

#include "solvers/ppo/orthogonal.hpp"

#include <rddl/values/philox.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace rddlc::solvers {

namespace {

class Normals {
  public:
    explicit Normals(std::uint64_t seed) : seed_(seed) {}
    double next() {
        using namespace rddl::philox;
        const auto words =
            generate<key_rounds>(Block<std::uint64_t>{counter_++, 0x696E6974, 0, 0},
                                 Key<std::uint64_t>{seed_ & 0xFFFFFFFF, seed_ >> 32});
        const auto unit = [](std::uint64_t word) {
            return (static_cast<double>(word & 0xFFFFFFFF) + 0.5) * 0x1p-32;
        };
        return std::sqrt(-2 * std::log(unit(words[0]))) *
               std::cos(2 * std::numbers::pi * unit(words[1]));
    }

  private:
    std::uint64_t seed_, counter_ = 0;
};

// Weights of any part of the model, one part after the other.
struct Initialiser {
    Normals normals;
    const std::function<bool()>& stops;

    void operator()(const Weights<float>& weights, double gain) {
        const int inputs = weights.inputs, outputs = weights.outputs;
        const bool wide = inputs >= outputs;
        const int rows = std::min(inputs, outputs), columns = std::max(inputs, outputs);
        const std::vector<double> orthogonal = orthogonal_rows(
            rows, columns, gain, [this] { return normals.next(); }, stops);
        const auto place = [columns](int r, int c) {
            return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(c);
        };
        for (int o = 0; o < outputs; ++o)
            for (int i = 0; i < inputs; ++i)
                weights(i, o) = static_cast<float>(orthogonal[wide ? place(o, i) : place(i, o)]);
    }

    void operator()(const Network& network, double last_gain, float* parameters) {
        for (const Layer& layer : network.layers)
            (*this)(layer.weights_in(parameters),
                    &layer == &network.layers.back() ? last_gain : std::numbers::sqrt2);
    }

    // Each of the three parts by itself.
    void operator()(const Gru& gru, float* parameters) {
        const auto parts = gru_parts(gru);
        for (const GruPart& part : parts) {
            (*this)(input_weights(gru, part, parameters), 1);
            (*this)(state_weights(gru, part, parameters), 1);
        }
        std::fill_n(parameters + parts.back().bias, gru.units, 1.0f);
    }
};

void allocate(PpoModel& model) {
    model.parameters.assign(parameter_count(model), 0.0f);
    model.normaliser = Normaliser(model.features());
}

}  // namespace

void lay_out_networks(PpoModel& model) {
    const int inputs = model.features() + model.recurrent;
    const auto network_of = [&](int outputs) {
        return make_network(inputs, model.hidden, outputs, model.recurrent, model.activation);
    };
    model.policy = network_of(model.actions.output_count());
    model.value = network_of(1);
    if (model.recurrent > 0) model.memory = make_gru(model.features(), model.recurrent);
}

std::size_t parameter_count(const PpoModel& model) {
    return model.memory_begin() + model.memory.parameters;
}

void make_networks(PpoModel& model) {
    lay_out_networks(model);
    allocate(model);
}

PpoModel model_without_parameters(const ObservationSpace& observations, const ActionSpace& actions,
                                  const PpoOptions& options) {
    PpoModel model;
    model.observations = observations;
    model.actions = actions;
    if (options.squashes) squash_bounded(model.actions);
    model.noise = options.noise;
    model.correlation = options.correlation;
    model.noise_steps = options.noise_steps;
    model.hidden = options.hidden;
    model.activation = options.activation;
    model.recurrent = options.recurrent;
    lay_out_networks(model);
    return model;
}

void make_parameters(PpoModel& model, const PpoOptions& options) {
    allocate(model);
    Initialiser initialise{Normals(options.seed), options.stops};
    initialise(model.policy, 0.01, model.parameters.data());
    initialise(model.value, 1, model.parameters.data() + model.value_begin());
    if (model.recurrent > 0)
        initialise(model.memory, model.parameters.data() + model.memory_begin());
    // A deviation that is a sum over units is divided so that the sum has about this deviation.
    const double parts = std::max(model.noisy_units(), 1);
    std::fill_n(model.parameters.data() + model.deviations_begin(), model.deviation_count(),
                static_cast<float>(options.log_deviation.value_or(0) - 0.5 * std::log(parts)));
}

PpoModel make_model(const ObservationSpace& observations, const ActionSpace& actions,
                    const PpoOptions& options) {
    PpoModel model = model_without_parameters(observations, actions, options);
    make_parameters(model, options);
    return model;
}

}  // namespace rddlc::solvers
