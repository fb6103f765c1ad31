// Deep reactive policies: a network of the state that goes up the exact gradient of its return
// (Bueno, de Barros, Maua and Sanner, "Deep reactive policies for planning in stochastic nonlinear
// domains", 2019; Gimelfarb, Taitler and Sanner, 2024).
//
// The network is a policy of PPO without values: files, exports and actors are the same. The same
// options give the same bytes on the same kind of processor.
#pragma once

#include "solvers/batches/stops.hpp"
#include "solvers/drp/options.hpp"
#include "solvers/gradients/step_derivatives.hpp"
#include "solvers/ppo/model.hpp"

#include <rddl/simulator.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

namespace rddlc::solvers {

struct DrpProgress {
    std::int64_t steps = 0, gradients = 0;  // since the beginning
    // The mean of the last update's returns, which are relaxed and discounted; nan before a return.
    double mean_return = std::numeric_limits<double>::quiet_NaN();
    // The length of the last gradient; nan before the first one.
    double gradient_length = std::numeric_limits<double>::quiet_NaN();
    double mean_length = 0;  // of all gradients, the last ones more than the others
    double seconds = 0;      // of the last update
};

class DrpTrainer {
  public:
    // Throws a Failure where the problem has no derivatives, no end, is observed in part, or takes
    // more memory than it may. The simulator must outlive this.
    DrpTrainer(const rddl_simulator& simulator, const DrpOptions& options,
               const DerivativesSource& derivatives);
    ~DrpTrainer();

    // Some gradient steps; no more of them once `is_late` says so, which is asked often. Then the
    // next call makes the rest of them. Throws a Failure where no episode of one has a finite
    // return.
    void update(const Stops& is_late = {});
    bool done() const;  // the options' steps are made, and the last update is complete

    const PpoModel& model() const;
    const DrpOptions& options() const;  // with what it has chosen by itself
    const DrpProgress& progress() const;

    // All that it takes to continue as if nothing had happened.
    std::string save() const;
    // Loads the state of a trainer with the same options. Throws a Failure if the bytes are not
    // such a state, or are of another problem.
    void load(std::string_view bytes);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rddlc::solvers
