// The simulator is a header.
#include "tank.hpp"

#include "episode.hpp"

int main() { return print_episode(tank_one::simulator()); }
