// The simulator is linked.
#include "episode.hpp"

extern "C" const rddl_simulator* rddl_simulator_tank_one(void);

int main() { return print_episode(rddl_simulator_tank_one()); }
