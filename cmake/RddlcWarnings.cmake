# What every target of our own code is compiled with.
add_library(rddlc_options INTERFACE)
target_compile_options(rddlc_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wconversion -Wno-sign-conversion
  # Interpreter and compiled simulators agree bit for bit: no fused multiply-add.
  -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 sees overlaps in std::string's operator+ that are not there (GCC bug 105651).
  target_compile_options(rddlc_options INTERFACE -Wno-restrict)
endif()
if(RDDLC_SANITIZE)
  # g++ warns of things that are not so in code that the sanitizers have instrumented
  # (GCC bug 105616): the plain build is the one whose warnings are errors.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
else()
  target_compile_options(rddlc_options INTERFACE -Werror)
endif()
if(RDDLC_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
  add_link_options(-fsanitize=fuzzer-no-link)
endif()
