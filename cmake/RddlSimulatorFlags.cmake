# The flags with which simulators are compiled, by rddl_add_simulator and by rddlc and rddl at run
# time (compiler/driver/cpp_compiler.cpp), as far as the compiler accepts them. Global, as functions
# are: rddl_add_simulator may be called in another folder than the one that includes this.

# These flags give right results in all code that includes the runtime: the same digits as the
# interpreter's, and no copies of loops over constant tables, in which GCC 12 is wrong
# (rddl/values/tables.hpp).
set_property(GLOBAL PROPERTY RDDL_NEEDED_FLAGS
  -ffp-contract=off -fno-tree-loop-distribute-patterns)

# These flags are for speed. Lanes are vectors already: GCC would also put numbers of one
# environment together, which costs more than it gains where they then wait for each other, as in a
# polynomial. It would keep the coefficients of polynomials that are evaluated twice in registers
# (gcse), and numbers elsewhere. The body of a loop over several objects stands in two calls
# (rddl/object_lanes/objects.hpp), which GCC would take for a reason to inline neither.
set_property(GLOBAL PROPERTY RDDL_FAST_FLAGS
  -O3 -fno-tree-slp-vectorize -fno-gcse --param=max-inline-insns-single=400)

include(CheckCXXCompilerFlag)

# rddl_add_flags(<target> PRIVATE|INTERFACE RDDL_NEEDED_FLAGS|RDDL_FAST_FLAGS ...)
#
# A flag that the compiler warns of is not taken, as clang does of those that mean nothing to it. Who makes
# it warn of everything anyway, is asked without -Werror.
function(rddl_add_flags target visibility)
  set(CMAKE_REQUIRED_QUIET TRUE)
  set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
  check_cxx_compiler_flag(-Werror RDDL_COMPILES_WITHOUT_WARNINGS)
  if(RDDL_COMPILES_WITHOUT_WARNINGS)
    list(APPEND CMAKE_REQUIRED_FLAGS -Werror)
  endif()
  foreach(property IN LISTS ARGN)
    get_property(flags GLOBAL PROPERTY ${property})
    foreach(flag IN LISTS flags)
      string(MAKE_C_IDENTIFIER "RDDL_COMPILES_WITH_${flag}" taken)
      check_cxx_compiler_flag("${flag}" ${taken})
      if(${taken})
        target_compile_options(${target} ${visibility} ${flag})
      endif()
    endforeach()
  endforeach()
endfunction()
