// Simulators that the tests of solvers use.
#pragma once

#include "solver_delivery.h"
#include "solver_mountain_car.h"
#include "solver_network.h"
#include "solver_reservoir.h"
