# Text files as constants of a C++ file.
#
#   rddlc_embed(<output.cpp> HEADER emit/templates.hpp NAMESPACE rddlc::cpp::templates
#               source=<file> header=<file> ...)
#
# defines `const std::string_view source`, ..., which the header declares `extern`.
#
#   rddlc_embed_pages(<output.cpp> HEADER driver/explain.hpp NAMESPACE rddlc FILES <file> ...)
#
# defines `const std::span<const Page> pages`: the files' names without extension, and their texts.
#
# As a script (cmake -P), this file writes the output.
if(CMAKE_SCRIPT_MODE_FILE)
  set(text "#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\n\n")
  foreach(entry IN LISTS ENTRIES)
    string(REGEX MATCH "^([^=]+)=(.*)$" matched "${entry}")
    file(READ "${CMAKE_MATCH_2}" content)
    string(APPEND text "const std::string_view ${CMAKE_MATCH_1} = R\"rddlc(${content})rddlc\";\n\n")
  endforeach()
  if(DEFINED PAGES)
    string(APPEND text "static const Page all_pages[] = {\n")
    foreach(file IN LISTS PAGES)
      get_filename_component(name "${file}" NAME_WE)
      file(READ "${file}" content)
      string(APPEND text "{\"${name}\", R\"rddlc(${content})rddlc\"},\n")
    endforeach()
    string(APPEND text "};\n\nconst std::span<const Page> pages = all_pages;\n\n")
  endif()
  file(WRITE "${OUTPUT}" "${text}}  // namespace ${NAMESPACE}\n")
  return()
endif()

set(RDDLC_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

# A command that runs this file with the given definition and input files.
function(rddlc_embed_command output header namespace definition files)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DHEADER=${header} -DNAMESPACE=${namespace}
            "-D${definition}" -P ${RDDLC_EMBED_SCRIPT}
    DEPENDS ${files} ${RDDLC_EMBED_SCRIPT}
    COMMENT "Embedding texts for ${header}" VERBATIM)
endfunction()

function(rddlc_embed output)
  cmake_parse_arguments(ARG "" "HEADER;NAMESPACE" "" ${ARGN})
  set(files ${ARG_UNPARSED_ARGUMENTS})
  list(TRANSFORM files REPLACE "^[^=]+=" "")
  rddlc_embed_command(${output} ${ARG_HEADER} ${ARG_NAMESPACE}
                      "ENTRIES=${ARG_UNPARSED_ARGUMENTS}" "${files}")
endfunction()

function(rddlc_embed_pages output)
  cmake_parse_arguments(ARG "" "HEADER;NAMESPACE" "FILES" ${ARGN})
  rddlc_embed_command(${output} ${ARG_HEADER} ${ARG_NAMESPACE} "PAGES=${ARG_FILES}" "${ARG_FILES}")
endfunction()
