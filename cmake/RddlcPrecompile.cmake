# The headers that most files of a target include are compiled once: a quarter of the build's time.
#
#   rddlc_precompile(<target> [<ir/ir.hpp> ...])      # as they are included, in <>
#   rddlc_precompile(<target> FROM <other>)           # those of another target
#
# Without headers of its own a target uses those of rddlc_support, the standard library's. Files
# include what they need all the same: -DRDDLC_PRECOMPILE=OFF builds without.
option(RDDLC_PRECOMPILE "Compile common headers once" ON)

function(rddlc_precompile target)
  cmake_parse_arguments(PARSE_ARGV 1 given "" "FROM" "")
  set(headers ${given_UNPARSED_ARGUMENTS})
  if(NOT RDDLC_PRECOMPILE)
    return()
  endif()
  if(NOT headers AND NOT given_FROM AND NOT target STREQUAL "rddlc_support")
    set(given_FROM rddlc_support)
  endif()
  if(given_FROM)
    target_precompile_headers(${target} REUSE_FROM ${given_FROM})
    return()
  endif()
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory>
    <optional> <set> <span> <string> <string_view> <utility> <variant> <vector>
    <fmt/format.h> <fmt/ranges.h> ${headers})
endfunction()
