# rddl_add_solver(<target> DOMAIN <file> INSTANCE <file> SOLVER ppo|cgp [EXTERN <header>...] [OPTIONS <option>...])
#
# The program <target>: a solver with the simulator of one problem linked in. It needs neither Python nor a
# compiler nor the RDDL files.
#
#   <target> train --out FOLDER [--steps N] [--seed S] ...
#   <target> evaluate FOLDER/policy.json
#
# DOMAIN, INSTANCE, EXTERN and OPTIONS are those of rddl_add_simulator.
function(rddl_add_solver target)
  cmake_parse_arguments(ARG "" "DOMAIN;INSTANCE;SOLVER" "EXTERN;OPTIONS" ${ARGN})
  if(NOT ARG_SOLVER MATCHES "^(ppo|cgp)$")
    message(FATAL_ERROR "rddl_add_solver(${target}): SOLVER is ppo or cgp")
  endif()
  if(NOT TARGET rddl::${ARG_SOLVER}_program)
    message(FATAL_ERROR "rddl_add_solver(${target}): the solvers of rddlc are not here. "
      "find_package(rddlc COMPONENTS compiler solvers) finds them where they are installed.")
  endif()
  rddl_add_simulator(${target}_simulator DOMAIN ${ARG_DOMAIN} INSTANCE ${ARG_INSTANCE}
                     EXTERN ${ARG_EXTERN} OPTIONS ${ARG_OPTIONS})
  # The entry has a name that does not depend on the problem.
  target_compile_definitions(${target}_simulator PRIVATE RDDL_ENTRY=rddl_solver_simulator)
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${target}.rddl/nothing.cpp "// main() is in the library.\n")
  add_executable(${target} ${CMAKE_CURRENT_BINARY_DIR}/${target}.rddl/nothing.cpp)
  target_link_libraries(${target} PRIVATE rddl::${ARG_SOLVER}_program ${target}_simulator rddl::${ARG_SOLVER})
endfunction()
