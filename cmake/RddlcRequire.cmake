# rddlc_require(<what> <packages> <variable>...): stops with the names of the packages to install, if
# find_library, find_path or find_program has left one of the variables without a value.
function(rddlc_require what packages)
  foreach(variable ${ARGN})
    if(NOT ${variable})
      message(FATAL_ERROR "${what} is missing. Install ${packages}, or say where it lies: "
                          "-D${variable}=...\ndocs/troubleshooting.md names all packages.")
    endif()
  endforeach()
endfunction()
