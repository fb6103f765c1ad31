# Walls between folders: each has an include folder of its own that holds only a link to it, so only folders
# that it says it uses can be included.
#
#   rddlc_include_folder(<variable> <folder>)     the include folder that holds <folder>, by its name, alone
#
# A stage of the compiler: one folder, one static library.
#
#   rddlc_stage(check SOURCES check.cpp ... USES model ast support [LIBRARIES fmt::fmt ...] [FAST])
#
# USES names stages, and libraries of ours that are none as rddl::solvers. FAST is for what runs long: compiled for speed.
# Headers are included as "check/check.hpp"; including a stage that is not in USES does not compile.
include(RddlcUnity)

function(rddlc_include_folder variable folder)
  get_filename_component(name ${folder} NAME)
  set(include ${PROJECT_BINARY_DIR}/stages/${name})
  file(MAKE_DIRECTORY ${include})
  file(CREATE_LINK ${folder} ${include}/${name} SYMBOLIC)
  set(${variable} ${include} PARENT_SCOPE)
endfunction()

function(rddlc_stage stage)
  cmake_parse_arguments(ARG "FAST" "" "SOURCES;USES;LIBRARIES" ${ARGN})
  rddlc_include_folder(include ${CMAKE_CURRENT_SOURCE_DIR})
  list(TRANSFORM ARG_USES PREPEND rddlc_ REGEX "^[a-z_]+$")
  add_library(rddlc_${stage} STATIC ${ARG_SOURCES})
  target_include_directories(rddlc_${stage} PUBLIC $<BUILD_INTERFACE:${include}>)
  target_link_libraries(rddlc_${stage} PUBLIC ${ARG_USES} PRIVATE ${ARG_LIBRARIES} rddlc_options)
  if(ARG_FAST)
    rddlc_precompile(rddlc_${stage} FROM rddlc_fast_headers)
  else()
    target_link_libraries(rddlc_${stage} PRIVATE $<BUILD_INTERFACE:rddlc_cold>)
    rddlc_precompile(rddlc_${stage} FROM rddlc_cold_headers)
  endif()
  rddlc_unity(rddlc_${stage})
endfunction()
