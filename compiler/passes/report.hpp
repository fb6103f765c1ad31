// A pass's report of its work, for `rddlc --stats`.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace rddlc::passes {

// How often it did what: {"tables made scalars", 12}. A pass adds; what is zero is not shown.
using Report = std::map<std::string, std::int64_t>;

}  // namespace rddlc::passes
