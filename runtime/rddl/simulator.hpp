// All that an emitted simulator includes.
#pragma once

#include <rddl/interface/details.hpp>
#include <rddl/interface/simulator_table.hpp>
#include <rddl/interface/sites.hpp>
#include <rddl/lanes/lane.hpp>
#include <rddl/object_lanes/angles.hpp>
#include <rddl/object_lanes/chosen_objects.hpp>
#include <rddl/object_lanes/clearance.hpp>
#include <rddl/object_lanes/many_objects.hpp>
#include <rddl/object_lanes/moves.hpp>
#include <rddl/object_lanes/objects.hpp>
#include <rddl/object_lanes/rows.hpp>
#include <rddl/object_lanes/step_normals.hpp>
#include <rddl/object_lanes/step_numbers.hpp>
#include <rddl/object_lanes/sums_of_rows.hpp>
#include <rddl/object_lanes/weight_rows.hpp>
#include <rddl/random/distributions.hpp>
#include <rddl/simulator.h>
#include <rddl/step/compiled.hpp>
#include <rddl/values/bits.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/few_bits.hpp>
#include <rddl/values/linear_algebra.hpp>
#include <rddl/values/moderate.hpp>
#include <rddl/values/narrow_bits.hpp>
#include <rddl/values/ops.hpp>
#include <rddl/values/reductions.hpp>
#include <rddl/values/search.hpp>
#include <rddl/values/sliding_tables.hpp>
#include <rddl/values/tables.hpp>
#include <rddl/values/true_elements.hpp>
#include <rddl/values/unions.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

// A program that links batches.cpp, compiled once for many simulators, defines RDDL_LINKS_BATCHES.
#ifndef RDDL_LINKS_BATCHES
#include <rddl/interface/abi.hpp>
#endif
