// The simulator is a header.
#include "tank.hpp"

#include "episode.hpp"

int main() { return print_episode(rddl_simulators::tank_one::simulator()); }
