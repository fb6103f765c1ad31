# The files that `cmake --install` installs for other CMake projects (component "rddlc").
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
# Solvers as libraries and as programs, and planners (component "solvers").
if(TARGET rddl_ppo)
  set(solver_targets rddl_solvers rddl_ppo rddl_cgp rddl_drp rddl_planners rddl_solver_program rddl_ppo_program rddl_cgp_program)
  foreach(target IN LISTS solver_targets)
    string(REGEX REPLACE "^rddl_" "" name ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  endforeach()
  install(TARGETS ${solver_targets} rddlc_support rddlc_options EXPORT rddlcSolverTargets COMPONENT solvers)
  foreach(folder batches policies evaluation spaces action_distribution gradients files options ranks training network ppo cgp drp program)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/solvers/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/solvers
            COMPONENT solvers FILES_MATCHING PATTERN "*.hpp")
  endforeach()
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/planners DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
          COMPONENT solvers FILES_MATCHING PATTERN "*.hpp")
  install(FILES ${PROJECT_SOURCE_DIR}/support/failure.hpp ${PROJECT_SOURCE_DIR}/support/memory.hpp
          ${PROJECT_SOURCE_DIR}/support/files.hpp ${PROJECT_SOURCE_DIR}/support/number_word.hpp
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/support COMPONENT solvers)
  install(EXPORT rddlcSolverTargets NAMESPACE rddl:: DESTINATION ${package_folder} COMPONENT solvers)
  # All that is installed and built, for a build folder that holds the programs alone.
  add_custom_target(rddlc_installed)
  add_dependencies(rddlc_installed rddlc rddl ${solver_targets})
  if(TARGET rddl_mpi)
    add_dependencies(rddlc_installed rddl_mpi)
  endif()
endif()
# In a folder of their own, find_package() does not take the build folder for an installed package where
# PATH names its programs.
set(package_files ${PROJECT_BINARY_DIR}/package)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/rddlcConfig.cmake.in
  ${package_files}/rddlcConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${package_files}/rddlcConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${package_files}/rddlcConfig.cmake
              ${package_files}/rddlcConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/RddlAddSimulator.cmake
              ${CMAKE_CURRENT_LIST_DIR}/RddlAddSolver.cmake
              ${CMAKE_CURRENT_LIST_DIR}/RddlSimulatorFlags.cmake
        DESTINATION ${package_folder} COMPONENT rddlc)
