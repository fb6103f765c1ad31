# rddl_add_simulator(<target> DOMAIN <file> INSTANCE <file> [POLICY <file>] [EXTERN <header>...]
#                    [NAME <name>] [HEADER] [DETAILS] [OPTIONS <option>...])
#
# Compiles an RDDL problem into the library <target>, and again whenever its files or rddlc change.
#
#   DOMAIN, INSTANCE   relative to the current source folder; one file that holds both may be named
#                      as DOMAIN alone
#   POLICY             a file with a policy block
#   EXTERN             C++ headers that define external functions, relative to the current source folder
#   NAME               of the emitted file (default: the target's name)
#   HEADER             an interface library with <NAME>.hpp to include, instead of a static one
#   DETAILS            interm-fluents of the last step can be asked for, and objects that violate a precondition
#   OPTIONS            more options for rddlc, such as -Werror
#
# A static library is compiled for speed in any build type; a header takes the flags of those who include
# it, and wants -O3. The library exports `const rddl_simulator* rddl_simulator_<domain>_<instance>(void)`, which
# <NAME>.h declares for C and C++.
#
# rddl_compile_simulator(<target> <file>...)
#
# The static library of what rddlc has emitted before, with the flags that it needs: no rddlc is needed.
include(${CMAKE_CURRENT_LIST_DIR}/RddlSimulatorFlags.cmake)

function(rddl_compile_simulator target)
  add_library(${target} STATIC ${ARGN})
  target_link_libraries(${target} PUBLIC rddlc::runtime)
  rddl_add_flags(${target} PRIVATE RDDL_NEEDED_FLAGS RDDL_FAST_FLAGS)
endfunction()

function(rddl_add_simulator target)
  cmake_parse_arguments(ARG "HEADER;DETAILS" "DOMAIN;INSTANCE;POLICY;NAME" "EXTERN;OPTIONS" ${ARGN})
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "rddl_add_simulator: unknown arguments ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT ARG_DOMAIN)
    message(FATAL_ERROR "rddl_add_simulator(${target}): DOMAIN is missing")
  endif()
  if(NOT TARGET rddlc::rddlc)
    message(FATAL_ERROR "rddl_add_simulator(${target}): only the runtime of rddlc is here, not the compiler. "
      "Install that, too, or emit the text elsewhere and use rddl_compile_simulator.")
  endif()
  if(NOT ARG_NAME)
    set(ARG_NAME ${target})
  endif()
  set(inputs "")
  foreach(file IN ITEMS ${ARG_DOMAIN} ${ARG_INSTANCE} ${ARG_POLICY})
    get_filename_component(file ${file} ABSOLUTE BASE_DIR ${CMAKE_CURRENT_SOURCE_DIR})
    list(APPEND inputs ${file})
  endforeach()

  set(headers "")
  set(externs "")
  foreach(file IN LISTS ARG_EXTERN)
    get_filename_component(file ${file} ABSOLUTE BASE_DIR ${CMAKE_CURRENT_SOURCE_DIR})
    list(APPEND headers ${file})
    list(APPEND externs --extern ${file})
  endforeach()

  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}.rddl)
  set(extension .cpp)
  if(ARG_HEADER)
    set(extension .hpp)
  endif()
  set(output ${folder}/${ARG_NAME}${extension})
  set(products ${output})
  set(more "")
  if(NOT ARG_HEADER)
    list(APPEND products ${folder}/${ARG_NAME}.h)
    list(APPEND more --declare ${folder}/${ARG_NAME}.h)
  endif()
  if(ARG_DETAILS)
    list(APPEND more --details)
  endif()
  file(MAKE_DIRECTORY ${folder})
  add_custom_command(
    OUTPUT ${products}
    COMMAND rddlc::rddlc ${inputs} ${externs} ${more} -o ${output} -MD -MF ${output}.d ${ARG_OPTIONS}
    DEPENDS rddlc::rddlc ${inputs} ${headers}
    DEPFILE ${output}.d
    COMMENT "Compiling ${ARG_DOMAIN} ${ARG_INSTANCE}" VERBATIM)

  if(ARG_HEADER)
    add_library(${target} INTERFACE ${output})
    target_include_directories(${target} INTERFACE ${folder})
    target_link_libraries(${target} INTERFACE rddlc::runtime)
    rddl_add_flags(${target} INTERFACE RDDL_NEEDED_FLAGS)
  else()
    rddl_compile_simulator(${target} ${products})
    target_include_directories(${target} INTERFACE ${folder})
  endif()
endfunction()
