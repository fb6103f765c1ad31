# The headers that most files of a target include are compiled once: a quarter of the build's time.
#
#   rddlc_precompile(<target> [<ir/ir.hpp> ...])      # as they are included, in <>
#
# Without headers of its own a target uses those of rddlc_support, the standard library's. Files
# include what they need all the same: -DRDDLC_PRECOMPILE=OFF builds without.
option(RDDLC_PRECOMPILE "Compile common headers once" ON)

function(rddlc_precompile target)
  if(NOT RDDLC_PRECOMPILE)
    return()
  endif()
  if(NOT ARGN AND NOT target STREQUAL "rddlc_support")
    target_precompile_headers(${target} REUSE_FROM rddlc_support)
    return()
  endif()
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory>
    <optional> <set> <span> <string> <string_view> <utility> <variant> <vector>
    <fmt/format.h> <fmt/ranges.h> ${ARGN})
endfunction()
