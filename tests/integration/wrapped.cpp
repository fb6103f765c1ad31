// A shared library that holds a simulator, and hands it out under the name that loaded.cpp asks
// for.
#include "tank_simulator.h"

extern "C" RDDL_EXPORT const rddl_simulator* rddl_simulator_entry(void) {
    return rddl_simulator_tank_one();
}
