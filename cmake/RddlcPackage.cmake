# What `cmake --install` installs for other CMake projects (component "rddlc").
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/rddlc)

set_target_properties(rddlc_runtime PROPERTIES EXPORT_NAME runtime)
install(TARGETS rddlc_runtime EXPORT rddlcRuntimeTargets COMPONENT rddlc)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/runtime/rddl DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        COMPONENT rddlc FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h" PATTERN "*.cpp")
install(EXPORT rddlcRuntimeTargets NAMESPACE rddlc:: DESTINATION ${package_folder} COMPONENT rddlc)
if(TARGET rddlc)
  install(TARGETS rddlc EXPORT rddlcCompilerTargets RUNTIME COMPONENT rddlc)
  install(EXPORT rddlcCompilerTargets NAMESPACE rddlc:: DESTINATION ${package_folder} COMPONENT rddlc)
endif()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/rddlcConfig.cmake.in
  ${PROJECT_BINARY_DIR}/rddlcConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/rddlcConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/rddlcConfig.cmake
              ${PROJECT_BINARY_DIR}/rddlcConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/RddlAddSimulator.cmake
              ${CMAKE_CURRENT_LIST_DIR}/RddlSimulatorFlags.cmake
        DESTINATION ${package_folder} COMPONENT rddlc)
