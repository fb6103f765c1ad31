# rddl_add_simulator(<target> DOMAIN <file> INSTANCE <file> [POLICY <file>] [EXTERN <header>...]
#                    [NAME <name>] [ENTRY <name>] [HEADER] [DETAILS] [OPTIONS <option>...])
#
# Compiles an RDDL problem into the library <target>, and again whenever its files or rddlc change.
#
#   DOMAIN, INSTANCE   relative to the current source folder; one file that holds both may be named
#                      as DOMAIN alone
#   POLICY             a file with a policy block
#   EXTERN             C++ headers that define external functions, relative to the current source folder
#   NAME               of the emitted file (default: the target's name)
#   ENTRY              of the function that the library exports; two simulators of the same problem in one
#                      program need different ones (default: rddl_simulator_<domain>_<instance>)
#   HEADER             an interface library with <NAME>.hpp to include, instead of a static one
#   DETAILS            interm-fluents of the last step can be asked for, and objects that violate a precondition
#   OPTIONS            more options for rddlc, such as -Werror
#
# A static library is compiled for speed in any build type, and can be linked into shared ones; a header
# takes the flags of those who include it, and wants -O3. The library exports `const rddl_simulator* <ENTRY>(void)`,
# which <NAME>.h declares for C and C++.
#
# rddl_compile_simulator(<target> <file>...)
#
# The static library of what rddlc has emitted before, with the flags that it needs: no rddlc is needed.
include(${CMAKE_CURRENT_LIST_DIR}/RddlSimulatorFlags.cmake)

# Stops where nothing can compile a simulator.
function(rddl_require_cxx caller)
  get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
  if(NOT CXX IN_LIST languages)
    message(FATAL_ERROR "${caller}: simulators are C++, which this project does not enable. "
      "Write project(... LANGUAGES C CXX), or enable_language(CXX) before.")
  endif()
endfunction()

# rddl_absolute_files(<variable> <caller> <file>...): relative to the current source folder. They must exist.
function(rddl_absolute_files variable caller)
  set(files "")
  foreach(file IN LISTS ARGN)
    get_filename_component(absolute ${file} ABSOLUTE BASE_DIR ${CMAKE_CURRENT_SOURCE_DIR})
    get_source_file_property(generated ${absolute} GENERATED)
    if(NOT generated AND NOT EXISTS ${absolute})
      message(FATAL_ERROR "${caller}: there is no file '${file}' (${absolute})")
    endif()
    list(APPEND files ${absolute})
  endforeach()
  set(${variable} "${files}" PARENT_SCOPE)
endfunction()

function(rddl_compile_simulator target)
  rddl_require_cxx("rddl_compile_simulator(${target})")
  add_library(${target} STATIC ${ARGN})
  # These options are for programs and shared libraries, which see nothing but the entry.
  set_target_properties(${target} PROPERTIES
    POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_link_libraries(${target} PUBLIC rddlc::runtime)
  rddl_add_flags(${target} PRIVATE RDDL_NEEDED_FLAGS RDDL_FAST_FLAGS)
endfunction()

function(rddl_add_simulator target)
  cmake_parse_arguments(ARG "HEADER;DETAILS" "DOMAIN;INSTANCE;POLICY;NAME;ENTRY" "EXTERN;OPTIONS" ${ARGN})
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "rddl_add_simulator: unknown arguments ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT ARG_DOMAIN)
    message(FATAL_ERROR "rddl_add_simulator(${target}): DOMAIN is missing")
  endif()
  if(ARG_HEADER AND ARG_ENTRY)
    message(FATAL_ERROR "rddl_add_simulator(${target}): a HEADER has no ENTRY; its functions stand in a namespace")
  endif()
  rddl_require_cxx("rddl_add_simulator(${target})")
  if(NOT TARGET rddlc::rddlc)
    message(FATAL_ERROR "rddl_add_simulator(${target}): only the runtime of rddlc is here, not the compiler. "
      "Install that, too, or emit the text elsewhere and use rddl_compile_simulator.")
  endif()
  if(NOT ARG_NAME)
    set(ARG_NAME ${target})
  endif()
  rddl_absolute_files(inputs "rddl_add_simulator(${target})" ${ARG_DOMAIN} ${ARG_INSTANCE} ${ARG_POLICY})
  rddl_absolute_files(headers "rddl_add_simulator(${target})" ${ARG_EXTERN})
  set(externs "")
  foreach(file IN LISTS headers)
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
  if(ARG_ENTRY)
    list(APPEND more --entry ${ARG_ENTRY})
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
