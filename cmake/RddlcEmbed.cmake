# Text files as constants of a C++ file.
#
#   rddlc_embed(<output.cpp> HEADER emit/templates.hpp NAMESPACE rddlc::cpp::templates
#               source=<file> header=<file> ...)
#
# defines `const std::string_view source`, ..., which the header declares `extern`. As a script
# (cmake -P), this file writes the output.
if(CMAKE_SCRIPT_MODE_FILE)
  set(text "#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\n\n")
  foreach(entry IN LISTS ENTRIES)
    string(REGEX MATCH "^([^=]+)=(.*)$" matched "${entry}")
    set(name ${CMAKE_MATCH_1})
    file(READ "${CMAKE_MATCH_2}" content)
    string(APPEND text "const std::string_view ${name} = R\"rddlc(${content})rddlc\";\n\n")
  endforeach()
  file(WRITE "${OUTPUT}" "${text}}  // namespace ${NAMESPACE}\n")
  return()
endif()

set(RDDLC_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

function(rddlc_embed output)
  cmake_parse_arguments(ARG "" "HEADER;NAMESPACE" "" ${ARGN})
  set(files ${ARG_UNPARSED_ARGUMENTS})
  list(TRANSFORM files REPLACE "^[^=]+=" "")
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DHEADER=${ARG_HEADER}
            -DNAMESPACE=${ARG_NAMESPACE} "-DENTRIES=${ARG_UNPARSED_ARGUMENTS}"
            -P ${RDDLC_EMBED_SCRIPT}
    DEPENDS ${files} ${RDDLC_EMBED_SCRIPT}
    COMMENT "Embedding ${ARG_HEADER}" VERBATIM)
endfunction()
