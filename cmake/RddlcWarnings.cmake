# The options with which every target of our own code is compiled.
add_library(rddlc_options INTERFACE)
target_compile_options(rddlc_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wconversion -Wno-sign-conversion
  # Interpreter and compiled simulators agree bit for bit: no fused multiply-add.
  -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC collects its own garbage from 128 MB on, again and again, which takes a tenth of its time. Without
  # that, a compiler takes a fifth more memory, up to 1.3 GB.
  target_compile_options(rddlc_options INTERFACE --param=ggc-min-heapsize=1000000)
  # g++ 12 warns of much that is not so in the standard library (GCC bugs 105651, 105329, 105562).
  target_compile_options(rddlc_options INTERFACE -Wno-restrict -Wno-stringop-overflow -Wno-array-bounds
    -Wno-maybe-uninitialized)
endif()
# Options for code that never runs long, such as that of the command lines: it compiles in half to
# two thirds of the time of -O2.
add_library(rddlc_cold INTERFACE)
target_compile_options(rddlc_cold INTERFACE $<$<CONFIG:Release,RelWithDebInfo>:-Og>)
if(RDDLC_SANITIZE)
  # A null pointer ends the program without a test at each use, which would take a third of the build.
  # Tests of each pointer's alignment and overflow take another third. The address sanitizer finds where a
  # pointer out of range is used, and runtime.sanitized_interface tests the alignment of records.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize=null,vptr,alignment,pointer-overflow
                      -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()
# g++ warns of things that are not so in instrumented code (GCC bug 105616).
if(RDDLC_WARNINGS_AS_ERRORS AND NOT (RDDLC_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU"))
  target_compile_options(rddlc_options INTERFACE -Werror)
endif()
if(RDDLC_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
  add_link_options(-fsanitize=fuzzer-no-link)
endif()
