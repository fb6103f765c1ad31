// The options of CGP.
#pragma once

#include "solvers/cgp/search.hpp"
#include "solvers/options/options.hpp"

namespace rddlc::solvers {

const OptionTable<CgpOptions>& cgp_option_table();

}  // namespace rddlc::solvers
