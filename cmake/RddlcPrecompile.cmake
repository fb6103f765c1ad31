# The headers that most files include are compiled once for all targets: those of the standard library.
# Headers of our own are not worth it, since files that include them are compiled together (RddlcUnity).
#
#   rddlc_precompile(<target> [FROM <other>])           those of rddlc_support, or of another target
#   rddlc_precompile_headers(<target> [<header> ...])   makes them, with more headers: as they are included, in <>
#
# Both targets are compiled at the same level of optimisation, or GCC 12 crashes.
#
# Files include what they need all the same: -DRDDLC_PRECOMPILE=OFF builds without.
option(RDDLC_PRECOMPILE "Compile common headers once" ON)

function(rddlc_precompile_headers target)
  if(RDDLC_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE
      <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory>
      <optional> <set> <span> <string> <string_view> <utility> <variant> <vector>
      <fmt/format.h> <fmt/ranges.h> ${ARGN})
  endif()
endfunction()

function(rddlc_precompile target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "FROM" "")
  if(NOT ARG_FROM)
    set(ARG_FROM rddlc_support)
  endif()
  if(target STREQUAL ARG_FROM)
    rddlc_precompile_headers(${target})
  elseif(RDDLC_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${ARG_FROM})
  endif()
endfunction()
