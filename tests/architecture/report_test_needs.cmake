# cmake [-DRDDLC_BUILD_TESTS=ON] -P: what a configuration says where nothing that the tests need is found.
set(CMAKE_DISABLE_FIND_PACKAGE_GTest ON)
set(CMAKE_FIND_USE_CMAKE_SYSTEM_PATH OFF)
set(CMAKE_FIND_USE_SYSTEM_ENVIRONMENT_PATH OFF)
include(${CMAKE_CURRENT_LIST_DIR}/../../cmake/RddlcTestNeeds.cmake)
rddlc_report_missing_test_needs()
