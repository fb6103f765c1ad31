# What simulators are compiled with, as far as the compiler takes it: compiler/driver/cpp_compiler.cpp
# asks for the same flags and says why.
include(CheckCXXCompilerFlag)

# rddl_add_flags_if_taken(<target> PRIVATE|INTERFACE <flag> ...)
function(rddl_add_flags_if_taken target visibility)
  foreach(flag IN LISTS ARGN)
    string(MAKE_C_IDENTIFIER "RDDL_TAKES_${flag}" taken)
    set(CMAKE_REQUIRED_QUIET TRUE)
    check_cxx_compiler_flag("${flag}" ${taken})
    if(${taken})
      target_compile_options(${target} ${visibility} ${flag})
    endif()
  endforeach()
endfunction()

# For right results in all code that includes the runtime.
function(rddl_add_needed_flags target visibility)
  rddl_add_flags_if_taken(${target} ${visibility}
    -ffp-contract=off -fno-tree-loop-distribute-patterns)
endfunction()

# For speed, whatever the build type.
function(rddl_add_fast_flags target)
  rddl_add_flags_if_taken(${target} PRIVATE
    -O3 -fno-tree-slp-vectorize -fno-gcse --param=max-inline-insns-single=400)
endfunction()
