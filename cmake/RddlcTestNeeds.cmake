# Packages that only the tests need: RDDLC_TESTS_POSSIBLE, and RDDLC_MISSING_FOR_TESTS with the
# packages of Debian that are missing.
find_package(GTest QUIET)
# Reference distributions and the reference of Philox: headers alone.
find_path(RDDLC_BOOST_INCLUDE boost/math/distributions.hpp)
find_path(RDDLC_RANDOM123_INCLUDE Random123/philox.h)

set(RDDLC_MISSING_FOR_TESTS)
if(NOT GTest_FOUND)
  list(APPEND RDDLC_MISSING_FOR_TESTS "GoogleTest (libgtest-dev)")
endif()
if(NOT RDDLC_BOOST_INCLUDE)
  list(APPEND RDDLC_MISSING_FOR_TESTS "the headers of Boost.Math (libboost-dev)")
endif()
if(NOT RDDLC_RANDOM123_INCLUDE)
  list(APPEND RDDLC_MISSING_FOR_TESTS "the headers of Random123 (librandom123-dev)")
endif()
set(RDDLC_TESTS_POSSIBLE ON)
if(RDDLC_MISSING_FOR_TESTS)
  set(RDDLC_TESTS_POSSIBLE OFF)
endif()

# Reports an error if the tests are asked for, otherwise why they are not built.
function(rddlc_report_missing_test_needs)
  if(RDDLC_TESTS_POSSIBLE OR RDDLC_RUNTIME_ONLY)
    return()
  endif()
  list(JOIN RDDLC_MISSING_FOR_TESTS ", " missing)
  if(RDDLC_BUILD_TESTS)
    message(FATAL_ERROR "The tests (RDDLC_BUILD_TESTS) cannot be built without: ${missing}.")
  endif()
  message(STATUS "The tests are not built: they need ${missing}.")
endfunction()
