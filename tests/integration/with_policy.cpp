// The simulator is linked with a policy from a file of its own.
#include "integration_filled_tank.h"

#include <cstdint>
#include <cstring>

namespace {

struct State {
    double water[3];
    std::uint8_t leaks[3];
};

bool acts_as_written(const rddl_simulator& simulator, rddl_batch* batch) {
    const rddl_transition nothing{};
    for (int step = 0; step < 20; ++step) {
        State state;
        std::uint8_t pump[3];
        if (simulator.get_state(batch, 0, 1, &state) != RDDL_OK) return false;
        if (simulator.policy_act(batch, pump) != RDDL_OK) return false;
        for (int tank = 0; tank < 3; ++tank)
            if (pump[tank] != (state.water[tank] < 5.0)) return false;
        if (simulator.step(batch, pump, &nothing) != RDDL_OK) return false;
    }
    return true;
}

}  // namespace

int main() {
    const rddl_simulator& simulator = *filled_tank();
    if (!simulator.policy || std::strcmp(simulator.policy->name, "fill") != 0) return 1;
    rddl_batch_options options{};
    options.seed = 7;
    rddl_batch* const batch = simulator.create(&simulator, &options);
    const bool good = batch && acts_as_written(simulator, batch);
    simulator.destroy(batch);
    return good ? 0 : 1;
}
