// Two simulators of the same problem in one program, distinguished by their entries.
#include "integration_filled_tank.h"
#include "tank.h"

int main() {
    const bool plain_has_policy = rddl_simulator_tank_one()->policy != nullptr;
    const bool filled_has_policy = filled_tank()->policy != nullptr;
    return !plain_has_policy && filled_has_policy ? 0 : 1;
}
