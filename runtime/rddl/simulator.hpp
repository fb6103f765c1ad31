// All that an emitted simulator includes.
#pragma once

#include <rddl/bits.hpp>
#include <rddl/compiled.hpp>
#include <rddl/context.hpp>
#include <rddl/details.hpp>
#include <rddl/distributions.hpp>
#include <rddl/lane.hpp>
#include <rddl/linear_algebra.hpp>
#include <rddl/moderate.hpp>
#include <rddl/objects.hpp>
#include <rddl/ops.hpp>
#include <rddl/reductions.hpp>
#include <rddl/rows.hpp>
#include <rddl/search.hpp>
#include <rddl/simulator.h>
#include <rddl/simulator_table.hpp>
#include <rddl/sites.hpp>
#include <rddl/tables.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

// A program that links batches.cpp, compiled once for many simulators, defines RDDL_LINKS_BATCHES.
#ifndef RDDL_LINKS_BATCHES
#include <rddl/abi.hpp>
#endif
