// Simulators that the tests of solvers use.
#pragma once

#include "solver_delivery.h"
#include "solver_mountain_car.h"
#include "solver_network.h"
#include "solver_reservoir.h"
#include "solver_t_maze.h"

#include <vector>

// Partially observed: a policy that forgets has a return of at most 1.95 of 4.
inline const rddl_simulator& maze() {
    return *rddl_simulator_t_maze_t_maze_1();
}

// All kinds of actions among them.
inline std::vector<const rddl_simulator*> simulators() {
    return {rddl_simulator_mountain_car_mountain_car_1(), rddl_simulator_reservoir_reservoir_1(),
            rddl_simulator_network_network_1(), rddl_simulator_delivery_delivery_1()};
}
