# The headers that most files include are compiled once for all targets: those of the standard library.
# Headers of our own are not worth it, since files that include them are compiled together (RddlcUnity).
#
#   rddlc_precompile(<target> FROM <other>)             those of another target: rddlc_fast_headers, rddlc_cold_headers
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
  if(RDDLC_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${ARG_FROM})
  endif()
endfunction()

# One set for code that is compiled for speed, and one for the rest (rddlc_cold).
foreach(kind fast cold)
  add_library(rddlc_${kind}_headers OBJECT ${CMAKE_CURRENT_LIST_DIR}/no_code.cpp)
  target_link_libraries(rddlc_${kind}_headers PRIVATE rddlc_options fmt::fmt $<$<STREQUAL:${kind},cold>:rddlc_cold>)
  rddlc_precompile_headers(rddlc_${kind}_headers)
endforeach()
