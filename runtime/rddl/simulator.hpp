// All that an emitted simulator includes.
#pragma once

#include <rddl/abi.hpp>
#include <rddl/batch.hpp>
#include <rddl/compiled.hpp>
#include <rddl/context.hpp>
#include <rddl/distributions.hpp>
#include <rddl/lane.hpp>
#include <rddl/linear_algebra.hpp>
#include <rddl/ops.hpp>
#include <rddl/reductions.hpp>
#include <rddl/search.hpp>
#include <rddl/simulator.h>
#include <rddl/sites.hpp>
#include <rddl/tables.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
